"""Way of the wheels and turn of the gyro between two instants, and the mean of poses of a standing robot."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional, Sequence, Tuple

from mtr_core.se2 import Pose2

from .readings import ReadingsUnusable

# Before a turn the gyro has to be heard at rest for so long; its offset is the mean of that.
REST_S = 3.0
# Of the turn's rate at rest; a gyro's offset is below, and a robot that turns above.
REST_RADPS = 0.1


def mean_pose(poses: Sequence[Pose2]) -> Pose2:
    """Mean of poses that hardly differ."""
    first = poses[0]
    offsets = [first.inverse() @ pose for pose in poses]
    count = len(offsets)
    return first @ Pose2(sum(each.x for each in offsets) / count, sum(each.y for each in offsets) / count,
                         sum(each.heading for each in offsets) / count)


def way_between(start: Pose2, end: Pose2) -> float:
    """Straight way in m, negative when it leads backwards."""
    moved = start.inverse() @ end
    return math.copysign(math.hypot(moved.x, moved.y), moved.x)


class GyroTurn:
    """The turn since begin(), by trapezoids; the offset is the mean rate of the rest before."""

    def __init__(self) -> None:
        self._recent: List[Tuple[float, float]] = []
        self._last: Optional[Tuple[float, float]] = None
        self._offset_radps = math.nan
        self._turn_rad = 0.0

    def add(self, stamp_s: float, rate_radps: float) -> None:
        """A sample of the gyro; one that is not newer is dropped."""
        if self._last is not None and stamp_s <= self._last[0]:
            return
        if self._last is not None and not math.isnan(self._offset_radps):
            mean_radps = 0.5 * (rate_radps + self._last[1]) - self._offset_radps
            self._turn_rad += mean_radps * (stamp_s - self._last[0])
        self._last = (stamp_s, rate_radps)
        self._recent = [each for each in self._recent if each[0] > stamp_s - REST_S] + [self._last]

    def begin(self) -> None:
        """Count from here."""
        rates = [rate for _, rate in self._recent]
        spans = bool(self._recent) and self._recent[-1][0] - self._recent[0][0] > 0.8 * REST_S
        is_at_rest = spans and max(map(abs, rates)) < REST_RADPS
        self._offset_radps = sum(rates) / len(rates) if is_at_rest else math.nan
        self._turn_rad = 0.0

    def turn_rad(self) -> float:
        """Since begin(), positive to the left; ReadingsUnusable when there was no rest before it."""
        if math.isnan(self._offset_radps):
            raise ReadingsUnusable(f"The gyro was not heard at rest for {REST_S:g} s before the turn; let the robot "
                                   "stand, and begin again.")
        return self._turn_rad
