"""Room on the disks that the robot writes to: how much is enough for a day, and from when on one is full."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import shutil
from typing import Callable, Iterable, NamedTuple, Optional, Tuple

MEGA = 1e6
# A day of logs and some bags: a preflight asks for it, and a recording leaves it. The share is of the whole disk.
RESERVE_BYTES, RESERVE_SHARE = 1e9, 0.05
# A chosen limit, twice what one file of the logs may become (setup/robot/tidy_logs). With none at all logs end in the
# middle, and a node that is started again does not find the Car that was mapped: its memory could not be written.
FULL_MB = 200.0
# Of the limit: with so much a full disk is none any more, so that a log that grows and is cut does not tell it again.
FINE_SHARE = 1.25
# Total, used and free bytes of a path's disk, as shutil.disk_usage says them.
Usage = Callable[[pathlib.Path], Tuple[int, int, int]]


class Room(NamedTuple):
    """Of the disk that a folder lies on, as far as whoever asks may use it."""

    folder: pathlib.Path
    total_bytes: float
    free_bytes: float

    @property
    def reserve_bytes(self) -> float:
        """What has to be free before a day of work."""
        return max(RESERVE_BYTES, RESERVE_SHARE * self.total_bytes)


def room_at(folder: pathlib.Path, usage: Usage = shutil.disk_usage) -> Optional[Room]:
    """Of a folder that is there or will be made; None when nothing is told, not even of what it lies in."""
    for place in (folder, *folder.parents):
        with contextlib.suppress(OSError):
            total, _, free = usage(place)
            return Room(folder, total, free)
    return None


class DiskLimit:
    """Remembers whether a disk was full, so that one which is nearly so is not told again and again."""

    def __init__(self, full_mb: float):
        self._full_mb = full_mb
        self._was_full = False

    @property
    def needed_mb(self) -> float:
        """What has to be free until a full disk is none any more."""
        return FINE_SHARE * self._full_mb

    def full(self, rooms: Iterable[Room]) -> Optional[Room]:
        """The first that is full, None when none is."""
        limit_mb = self.needed_mb if self._was_full else self._full_mb
        found = next((room for room in rooms if room.free_bytes < MEGA * limit_mb), None)
        self._was_full = found is not None
        return found
