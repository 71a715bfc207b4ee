"""Where the robot is to be, and how fast, at each instant until it stands."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from functools import cached_property
from typing import List

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle

from .speeds import SAMPLE_S


@dataclass(frozen=True)
class Reference:
    """Pose and velocity to have at an instant.

    Attributes:
        way: since the motion's beginning, m, or on the spot rad.
    """

    pose: Pose2
    linear_mps: float
    angular_radps: float
    way: float


class Trajectory:
    """Samples of a motion; constant after their end.

    Attributes:
        duration_s: until the robot is to stand.
        length_m: way of the turn centre.
        ways: (n,) m, or on the spot rad, since the beginning.
        poses: (n, 3) x, y in m and heading in rad of the turn centre, in the frame of the plan.
        linear, angular: (n,) m/s, backwards negative, and rad/s.
    """

    def __init__(self, ways: FloatArray, poses: FloatArray, linear: FloatArray, angular: FloatArray, length_m: float):
        self.duration_s = SAMPLE_S * (len(ways) - 1)
        self.length_m = length_m
        self.ways, self.poses, self.linear, self.angular = ways, poses, linear, angular

    @cached_property
    def _rows(self) -> List[List[float]]:
        rows: List[List[float]] = np.column_stack((self.ways, self.poses, self.linear, self.angular)).tolist()
        return rows

    def at(self, time_s: float) -> Reference:
        """Reference at a time since the beginning."""
        place = min(max(time_s, 0.0) / SAMPLE_S, len(self._rows) - 1.0)
        index = min(int(place), len(self._rows) - 2)
        share = place - index
        way, x, y, heading, linear, angular = [
            a + share * (b - a) for a, b in zip(self._rows[index], self._rows[index + 1])]
        if time_s >= self.duration_s:
            linear = angular = 0.0
        return Reference(Pose2(x, y, wrap_angle(heading)), linear, angular, way)
