"""Poses of the last while, and the pose at any instant between two of them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
import contextlib
import math
from collections import deque
from dataclasses import dataclass
from typing import Iterable

from ..clocks.clock_step import clock_was_set
from ..geometry.pose import Pose, wrap_angle
from ..robot_status import RobotStatus

# Between two Status messages at 10 Hz a straight line is exact to 1 mm at the robot's acceleration of 0.5 m/s2. Over a
# longer gap it would be a guess.
MAX_GAP_S = 0.5
KEPT_S = 60.0
# Noise of the odometry at rest is below it.
STANDING_MPS = 0.02
# A pose is at most that old when it is sent. So long after the robot's clock was set a stamp may be one of before.
_MAX_AGE_S = 1.0
# Middles of eight equal parts of a span about 0 whose ends are -1 and 1.
_PARTS = tuple((2 * index - 7) / 8.0 for index in range(8))


class PoseUnknown(Exception):
    """The pose at the wanted instant is not known well enough; the text says why."""


@dataclass(frozen=True)
class PoseSample:
    """Pose of base_link in the Car coordinate system at an instant of robot time, with what a distance needs of it.

    covariance: variance along x, along y, and covariance of the two, in m2; NaN when the robot does not say.
    """

    stamp_s: float
    pose: Pose
    speed_mps: float
    position_sigma_m: float
    heading_sigma_rad: float
    key_x: float
    key_y: float
    covariance: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    key_height_m: float = math.nan


def worst_sigma(sigmas: Iterable[float]) -> float:
    """The greatest of some sigmas; NaN, which is not known, when one of them is not, or there is none."""
    each = tuple(sigmas)
    return math.nan if any(map(math.isnan, each)) else max(each, default=math.nan)


def worst_known(sigmas: Iterable[float | None]) -> float | None:
    """The same of a record, where what is not known is None."""
    worst = worst_sigma(math.nan if sigma is None else sigma for sigma in sigmas)
    return None if math.isnan(worst) else worst


def sample_of(status: RobotStatus) -> PoseSample:
    """What a Status says of the pose, whether it is valid or not."""
    return PoseSample(
        status.stamp_s, Pose(status.x, status.y, status.heading), status.speed_mps, status.position_sigma_m,
        status.heading_sigma_rad, status.key_x, status.key_y,
        (status.variance_x_m2, status.variance_y_m2, status.covariance_xy_m2), status.key_height_m)


class PoseHistory:
    """Valid poses in order of robot time."""

    def __init__(self) -> None:
        self._samples: deque[PoseSample] = deque()
        self._before: RobotStatus | None = None
        self._ambiguous_until_s = -math.inf

    def add(self, status: RobotStatus) -> None:
        """Remember the pose of a Status, unless it is invalid, not finite or not newer than the last one.

        When the robot's clock was set, all before is forgotten, and no pose is taken until its stamp can only be one of
        the clock as it is now.
        """
        before, self._before = self._before, status
        if before is not None and clock_was_set(before, status):
            self._samples.clear()
            self._ambiguous_until_s = status.steady_s + _MAX_AGE_S
        if status.steady_s < self._ambiguous_until_s or not _is_known(status):
            return
        if self._samples and status.stamp_s <= self._samples[-1].stamp_s:
            return
        self._samples.append(sample_of(status))
        while status.stamp_s - self._samples[0].stamp_s > KEPT_S:
            self._samples.popleft()

    @property
    def samples(self) -> tuple[PoseSample, ...]:
        """All that are remembered."""
        return tuple(self._samples)

    @property
    def moved_s(self) -> float:
        """Stamp of the newest pose in motion; minus infinity when none is remembered."""
        return next((sample.stamp_s for sample in reversed(self._samples) if abs(sample.speed_mps) > STANDING_MPS),
                    -math.inf)

    def clear(self) -> None:
        """Forget everything: the robot's clock or the Car's frame is another one now."""
        self._samples.clear()

    def at(self, time_s: float) -> PoseSample:
        """Pose at an instant, interpolated; PoseUnknown when no two valid poses enclose it closely."""
        samples = self._samples
        if not math.isfinite(time_s):
            raise PoseUnknown("The instant of the event is not known.")
        index = bisect.bisect_left([sample.stamp_s for sample in samples], time_s)
        if index < len(samples) and samples[index].stamp_s == time_s:
            return samples[index]
        if index in (0, len(samples)):
            raise PoseUnknown(f"No poses of the robot enclose the instant {time_s:.3f} s.")
        before, after = samples[index - 1], samples[index]
        gap_s = after.stamp_s - before.stamp_s
        if gap_s > MAX_GAP_S:
            raise PoseUnknown(f"The robot's pose is unknown for {gap_s:.1f} s around the instant {time_s:.3f} s.")
        return _between(before, after, (time_s - before.stamp_s) / gap_s, time_s)


    def about(self, time_s: float, half_s: float) -> tuple[PoseSample, ...]:
        """Poses at instants that are spread evenly up to so long before and behind an instant; those that are known."""
        found = []
        for part in _PARTS if half_s > 0.0 else ():
            with contextlib.suppress(PoseUnknown):
                found.append(self.at(time_s + part * half_s))
        return tuple(found)


def _is_known(status: RobotStatus) -> bool:
    """A valid pose whose numbers are numbers; the domain does not rely on the link's check alone."""
    return status.pose_valid and all(map(math.isfinite, (
        status.stamp_s, status.x, status.y, status.heading, status.speed_mps, status.key_x, status.key_y)))


def _between(a: PoseSample, b: PoseSample, part: float, time_s: float) -> PoseSample:
    def mix(first: float, second: float) -> float:
        return first + part * (second - first)

    # Variances as positions are mixed: no error of either end is forgotten, as where localization takes hold again.
    variance_x, variance_y, covariance_xy = map(mix, a.covariance, b.covariance)
    turn = wrap_angle(b.pose.heading - a.pose.heading)
    pose = Pose(mix(a.pose.x, b.pose.x), mix(a.pose.y, b.pose.y), wrap_angle(a.pose.heading + part * turn))
    position_sigma_m = worst_sigma((a.position_sigma_m, b.position_sigma_m))
    heading_sigma_rad = worst_sigma((a.heading_sigma_rad, b.heading_sigma_rad))
    return PoseSample(time_s, pose, mix(a.speed_mps, b.speed_mps), position_sigma_m, heading_sigma_rad, b.key_x,
                      b.key_y, (variance_x, variance_y, covariance_xy), mix(a.key_height_m, b.key_height_m))
