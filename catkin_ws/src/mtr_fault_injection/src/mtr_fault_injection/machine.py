"""Faults of the computer: a full disk, and a processor with other load. No ROS inside."""
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
# With two busy processes per core, every other program must wait for one of them.
BUSY_PER_CORE = 2
BUSY = "while True: pass"


class FullDisk:
    """Fills the free space of a folder's disk with an unnamed file, which disappears with this process."""

    def __init__(self, folder: str, limit_mib: int):
        """limit_mib: largest free space that is filled, because filling more would take too long.

        Raises:
            FaultError: the disk has more free space, or the folder is missing.
        """
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
        """Release the disk space."""
        self._file.close()


class BusyProcessor:
    """Processes that only compute."""

    def __init__(self) -> None:
        self._processes: List[subprocess.Popen[bytes]] = []
        for _ in range(BUSY_PER_CORE * (os.cpu_count() or 1)):
            self._processes.append(subprocess.Popen([sys.executable, "-c", BUSY]))

    def end(self) -> None:
        """End the processes."""
        for process in self._processes:
            process.kill()
        for process in self._processes:
            process.wait()
