"""Conversion of a laser scan to points in map, each beam from the robot's pose at its own time."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

from .poses import PoseHistory

# Limits of a sweep, as in localization; drivers round the last angle of a whole turn.
MAX_SWEEP_S = 0.25
MAX_TURN_RAD = 1.01 * math.tau
# Remaining range bias after the adjustment of the map. Its covariance, which SurfaceMap does not contain, gives 3 mm
# (kMinBiasSigmaM of mtr_surfel_map), and 3.4 mm in the open (docs/accuracy.md).
ADJUSTED_BIAS_SIGMA_M = 0.0035


@dataclass(frozen=True)
class Scan:
    """One sweep; start_s is the time of the first beam, ranges_m (n,), base_from_lidar the mount of the LiDAR.

    is_rear: True for the rear LiDAR, False for the front one.
    """

    start_s: float
    beam_period_s: float
    first_angle_rad: float
    beam_angle_rad: float
    range_min_m: float
    range_max_m: float
    ranges_m: FloatArray
    base_from_lidar: Pose2
    is_rear: bool = False

    @property
    def makes_sense(self) -> bool:
        """Return True if times, angles and limits are finite and plausible for one turn; drivers may be broken."""
        numbers = (self.start_s, self.beam_period_s, self.first_angle_rad, self.beam_angle_rad, self.range_min_m,
                   self.range_max_m)
        steps = len(self.ranges_m) - 1
        return (all(map(math.isfinite, numbers)) and steps * abs(self.beam_angle_rad) <= MAX_TURN_RAD
                and 0.0 <= steps * self.beam_period_s <= MAX_SWEEP_S and self.range_min_m < self.range_max_m)


class RangeBias(NamedTuple):
    """Constant range errors of the LiDARs, and 1 sigma of the remaining error of each, in m."""

    front_m: float = 0.0
    rear_m: float = 0.0
    sigma_m: float = ADJUSTED_BIAS_SIGMA_M

    def of(self, is_rear: bool) -> float:
        """Return the bias of one LiDAR."""
        return self.rear_m if is_rear else self.front_m


# Bias of uncorrected ranges.
NO_BIAS = RangeBias()


@dataclass(frozen=True)
class Returns:
    """Points (n, 2) in map, and the positions of LiDAR and robot in the middle of the sweep, at time_s."""

    points: FloatArray
    viewer: FloatArray
    time_s: float
    robot: Pose2
    is_rear: bool = False


def returns_in_map(scan: Scan, poses: PoseHistory, range_bias: RangeBias = NO_BIAS) -> Optional[Returns]:
    """Return the returns of a scan; None for an implausible scan, or if poses do not cover it.

    range_bias: is subtracted.
    """
    if not scan.makes_sense:
        return None
    count = len(scan.ranges_m)
    index = np.arange(count)
    robot = poses.at(scan.start_s + index * scan.beam_period_s)
    if robot is None:
        return None
    ranges = np.asarray(scan.ranges_m, dtype=float)
    good = np.isfinite(ranges) & (ranges >= scan.range_min_m) & (ranges < scan.range_max_m)
    ranges = ranges - range_bias.of(scan.is_rear)
    mount = scan.base_from_lidar
    middle = Pose2(*(float(values[count // 2]) for values in robot))
    x, y, heading = (values[good] for values in robot)
    beam = scan.first_angle_rad + index[good] * scan.beam_angle_rad + mount.heading
    ahead, aside = mount.x + ranges[good] * np.cos(beam), mount.y + ranges[good] * np.sin(beam)
    cos, sin = np.cos(heading), np.sin(heading)
    points = np.column_stack((x + cos * ahead - sin * aside, y + sin * ahead + cos * aside))
    time_s = scan.start_s + (count // 2) * scan.beam_period_s
    return Returns(points, np.array(middle.apply(mount.x, mount.y)), time_s, middle, scan.is_rear)
