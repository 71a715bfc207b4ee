"""Faults of the computer: a full disk and a processor that is busy with something else. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import errno
import os
import pathlib
import subprocess
import sys
import tempfile
from typing import List

from .parts import FaultError

MIB = 1024 * 1024
# Two processes for each core: whoever wants to work waits for one of them.
BUSY_PER_CORE = 2
BUSY = "while True: pass"


class FullDisk:
    """Fills what is free of a folder's disk with a file without a name, so that it is gone with this process."""

    def __init__(self, folder: str, limit_mib: int):
        """limit_mib: a disk with more than that is not filled, for that would take long; FaultError says so."""
        if not folder:
            raise FaultError("There is no folder whose disk may be filled; name one with the parameter disk_folder.")
        if not pathlib.Path(folder).is_dir():
            raise FaultError(f"The folder {folder} of the parameter disk_folder is not there.")
        usage = os.statvfs(folder)
        free_mib = usage.f_bavail * usage.f_frsize // MIB
        if free_mib > limit_mib:
            raise FaultError(f"The disk of {folder} has {free_mib} MiB; at most {limit_mib} MiB are filled "
                             "(disk_limit_mib).")
        self._file = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115 - it lasts until `end`
        self._fill(MIB)
        self._fill(usage.f_bsize)

    def _fill(self, piece_bytes: int) -> None:
        piece = bytes(piece_bytes)
        while True:
            try:
                os.write(self._file.fileno(), piece)
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
                return

    def end(self) -> None:
        """Give it back."""
        self._file.close()


class BusyProcessor:
    """Processes that compute and nothing else."""

    def __init__(self) -> None:
        self._processes: List[subprocess.Popen[bytes]] = []
        for _ in range(BUSY_PER_CORE * (os.cpu_count() or 1)):
            self._processes.append(subprocess.Popen([sys.executable, "-c", BUSY]))

    def end(self) -> None:
        """End them."""
        for process in self._processes:
            process.kill()
        for process in self._processes:
            process.wait()
