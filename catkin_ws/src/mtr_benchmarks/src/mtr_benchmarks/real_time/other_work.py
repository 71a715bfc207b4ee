"""Load for a busy machine: processes that compute, and one that writes to the disk."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import subprocess
import sys
from typing import Iterator

COMPUTING = 4
_COMPUTE = "while True: pass"
_WRITE = """
import os, sys
block = os.urandom(1 << 20)
while True:
    with open(sys.argv[1], "wb") as file:
        for _ in range(64):
            file.write(block)
        file.flush()
        os.fsync(file.fileno())
"""


@contextlib.contextmanager
def other_work(folder: pathlib.Path, computing: int = COMPUTING) -> Iterator[None]:
    """Run processes that use all processors, and one that repeatedly writes 64 MiB to the folder, within the
    context."""
    written = folder / "other_work.bin"
    commands = [[sys.executable, "-c", _COMPUTE]] * computing + [[sys.executable, "-c", _WRITE, str(written)]]
    # With separate sessions, a scheduler that shares by session treats them as independent programs.
    processes = [subprocess.Popen(command, start_new_session=True) for command in commands]
    try:
        yield
    finally:
        for process in processes:
            process.kill()
        for process in processes:
            process.wait()
        written.unlink(missing_ok=True)
