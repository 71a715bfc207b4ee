"""A wall clock of the robot's processes that can be set while they run, without setting the machine's."""
# SPDX-License-Identifier: Apache-2.0
import mmap
import pathlib
import struct
import subprocess
from typing import Dict

SOURCE = pathlib.Path(__file__).with_name("set_clock.c")
OFFSET = struct.Struct("=q")
S = 1_000_000_000


class SettableClock:
    """Attributes:
        offset_s: what the clock is ahead of the machine's, s.
        variables: of the environment of processes that shall have this clock.
    """

    def __init__(self, folder: pathlib.Path):
        """Compile the library into a folder, which is made.

        Raises:
            subprocess.CalledProcessError: the compiler refuses it; it says why on stderr.
        """
        folder.mkdir(parents=True, exist_ok=True)
        library, self._file = (folder.resolve() / name for name in ("set_clock.so", "offset_ns"))
        subprocess.run(["gcc", "-std=gnu11", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-pthread",
                        "-o", str(library), str(SOURCE)], check=True)
        self._file.write_bytes(OFFSET.pack(0))
        self.offset_s = 0.0
        self.variables: Dict[str, str] = {"LD_PRELOAD": str(library), "MTR_CLOCK_OFFSET_FILE": str(self._file)}

    def set_by(self, step_s: float) -> None:
        """Put the clock forward, or back when negative, for all processes at one instant."""
        self.offset_s += step_s
        with self._file.open("r+b") as file, mmap.mmap(file.fileno(), OFFSET.size) as shared:
            shared[:] = OFFSET.pack(round(self.offset_s * S))
