"""Distance from the wheels and rotation from the gyro between two times, and the mean pose of a stationary robot."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional, Sequence, Tuple

from mtr_core.se2 import Pose2

from .readings import ReadingsUnusable

# Required rest before a turn; the mean rate during it is the gyro's offset.
REST_S = 3.0
# Limit of the rotation rate at rest; a gyro's offset is below, and a turning robot above.
REST_RADPS = 0.1


def mean_pose(poses: Sequence[Pose2]) -> Pose2:
    """Return the mean of similar poses."""
    first = poses[0]
    offsets = [first.inverse() @ pose for pose in poses]
    count = len(offsets)
    return first @ Pose2(sum(each.x for each in offsets) / count, sum(each.y for each in offsets) / count,
                         sum(each.heading for each in offsets) / count)


def way_between(start: Pose2, end: Pose2) -> float:
    """Return the straight distance in m, negative if backwards."""
    moved = start.inverse() @ end
    return math.copysign(math.hypot(moved.x, moved.y), moved.x)


class GyroTurn:
    """Rotation since begin(), by the trapezoidal rule; the offset is the mean rate of the rest before."""

    def __init__(self) -> None:
        self._recent: List[Tuple[float, float]] = []
        self._last: Optional[Tuple[float, float]] = None
        self._offset_radps = math.nan
        self._turn_rad = 0.0

    def add(self, stamp_s: float, rate_radps: float) -> None:
        """Add a sample of the gyro; samples that are not newer are dropped."""
        if self._last is not None and stamp_s <= self._last[0]:
            return
        if self._last is not None and not math.isnan(self._offset_radps):
            mean_radps = 0.5 * (rate_radps + self._last[1]) - self._offset_radps
            self._turn_rad += mean_radps * (stamp_s - self._last[0])
        self._last = (stamp_s, rate_radps)
        self._recent = [each for each in self._recent if each[0] > stamp_s - REST_S] + [self._last]

    def begin(self) -> None:
        """Start counting."""
        rates = [rate for _, rate in self._recent]
        spans = bool(self._recent) and self._recent[-1][0] - self._recent[0][0] > 0.8 * REST_S
        is_at_rest = spans and max(map(abs, rates)) < REST_RADPS
        self._offset_radps = sum(rates) / len(rates) if is_at_rest else math.nan
        self._turn_rad = 0.0

    def turn_rad(self) -> float:
        """Rotation since begin(), positive to the left; ReadingsUnusable without a rest before it."""
        if math.isnan(self._offset_radps):
            raise ReadingsUnusable(f"The gyro was not heard at rest for {REST_S:g} s before the turn; let the robot "
                                   "stand, and begin again.")
        return self._turn_rad
