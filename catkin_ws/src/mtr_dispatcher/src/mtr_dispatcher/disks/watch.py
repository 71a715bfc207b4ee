"""Detects full disks in a thread. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
import threading
import time
from typing import NamedTuple, Optional, Sequence

from .room import DiskLimit, Usage, room_at


class FullDisk(NamedTuple):
    """A disk without space. needed_mb: free space at which it no longer counts as full."""

    folder: str
    needed_mb: float


class DiskWatch:
    """Polls from its own thread, because a broken or remote disk answers late or never.

    Attributes:
        full: the first full disk in the order of the folders, or None.
    """

    def __init__(self, folders: Sequence[pathlib.Path], full_mb: float, period_wall_s: float,
                 usage: Usage = shutil.disk_usage):
        self.full: Optional[FullDisk] = None
        self._folders, self._period_wall_s, self._usage = folders, period_wall_s, usage
        self._limit = DiskLimit(full_mb)

    def start(self) -> None:
        """Start to poll."""
        threading.Thread(target=self._run, name="disk watch", daemon=True).start()

    def update(self) -> None:
        """Poll once; a disk that cannot be read does not count as full."""
        rooms = (room_at(folder, self._usage) for folder in self._folders)
        found = self._limit.full(room for room in rooms if room is not None)
        self.full = FullDisk(str(found.folder), self._limit.needed_mb) if found else None

    def _run(self) -> None:
        while True:
            self.update()
            time.sleep(self._period_wall_s)
