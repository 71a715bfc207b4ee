"""The robot's recent poses, at any time between them."""
# SPDX-License-Identifier: Apache-2.0
from collections import deque
from typing import Deque, Optional, Tuple

import numpy as np

from mtr_core.se2 import Pose2, wrap_angle

# Localization gives a pose each 20 ms; over a longer gap nothing is interpolated.
LONGEST_GAP_S = 0.1
KEPT = 100


class PoseHistory:
    """Valid poses of base_link in map by time."""

    def __init__(self) -> None:
        self._rows: Deque[Tuple[float, float, float, float]] = deque(maxlen=KEPT)

    def add(self, time_s: float, pose: Pose2) -> None:
        """Take the next pose; a time that is not later than the last starts anew."""
        heading = pose.heading
        if self._rows:
            if time_s <= self._rows[-1][0]:
                self._rows.clear()
            else:
                last = self._rows[-1][3]
                heading = last + wrap_angle(heading - last)
        self._rows.append((time_s, pose.x, pose.y, heading))

    def at(self, times_s: np.ndarray) -> Optional[Tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """x, y and heading at the times, None when they are not covered."""
        if len(self._rows) < 2 or len(times_s) == 0:
            return None
        rows = np.array(self._rows)
        known, begin, end = rows[:, 0], times_s.min(), times_s.max()
        if not known[0] <= begin <= end <= known[-1]:
            return None
        first = np.searchsorted(known, begin, side="right") - 1
        last = np.searchsorted(known, end, side="left")
        if last > first and np.diff(known[first:last + 1]).max() > LONGEST_GAP_S:
            return None
        return tuple(np.interp(times_s, known, rows[:, column]) for column in (1, 2, 3))

    def is_empty(self) -> bool:
        """True before the first pose."""
        return not self._rows

    def newest(self) -> Pose2:
        """Last pose; only when there is one."""
        _, x, y, heading = self._rows[-1]
        return Pose2(x, y, wrap_angle(heading))
