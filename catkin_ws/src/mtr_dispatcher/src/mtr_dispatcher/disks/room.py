"""Free space on the disks that the robot writes to: the reserve for a day, and the limit of a full disk."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import shutil
from typing import Callable, Iterable, NamedTuple, Optional, Tuple

MEGA = 1e6
# Space for a day of logs and some bags: a preflight requires it, and a recording keeps it free. RESERVE_SHARE is a
# fraction of the disk.
RESERVE_BYTES, RESERVE_SHARE = 1e9, 0.05
# Chosen limit, twice the largest size of one log file (setup/robot/tidy_logs). On a full disk logs are truncated, and a
# restarted node does not find the mapped Car, because its memory could not be written.
FULL_MB = 200.0
# Hysteresis as a multiple of the limit: a log that grows and is cut does not report a full disk again and again.
FINE_SHARE = 1.25
# Returns total, used and free bytes of a path's disk, like shutil.disk_usage.
Usage = Callable[[pathlib.Path], Tuple[int, int, int]]


class Room(NamedTuple):
    """Free space on the disk of a folder, as far as the calling user may use it."""

    folder: pathlib.Path
    total_bytes: float
    free_bytes: float

    @property
    def reserve_bytes(self) -> float:
        """Free space that a day of work requires."""
        return max(RESERVE_BYTES, RESERVE_SHARE * self.total_bytes)


def room_at(folder: pathlib.Path, usage: Usage = shutil.disk_usage) -> Optional[Room]:
    """Return the space for a folder that exists or will be created; None if neither it nor a parent can be read."""
    for place in (folder, *folder.parents):
        with contextlib.suppress(OSError):
            total, _, free = usage(place)
            return Room(folder, total, free)
    return None


class DiskLimit:
    """Detects a full disk with hysteresis, so that a disk near the limit is not reported again and again."""

    def __init__(self, full_mb: float):
        self._full_mb = full_mb
        self._was_full = False

    @property
    def needed_mb(self) -> float:
        """Free space at which a full disk no longer counts as full."""
        return FINE_SHARE * self._full_mb

    def full(self, rooms: Iterable[Room]) -> Optional[Room]:
        """Return the first full disk, or None."""
        limit_mb = self.needed_mb if self._was_full else self._full_mb
        found = next((room for room in rooms if room.free_bytes < MEGA * limit_mb), None)
        self._was_full = found is not None
        return found
