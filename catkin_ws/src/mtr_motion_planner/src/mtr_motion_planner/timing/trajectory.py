"""Planned pose and velocity at each instant until the robot is at rest."""
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
    """Planned pose and velocity at an instant.

    Attributes:
        way: distance since the start of the motion, m, or rad on the spot.
    """

    pose: Pose2
    linear_mps: float
    angular_radps: float
    way: float


class Trajectory:
    """Samples of a motion; constant after their end.

    Attributes:
        duration_s: time until the robot is at rest.
        length_m: path length of the turn centre.
        ways: (n,) distance since the start, m, or rad on the spot.
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
        """Return the reference at a time since the start."""
        place = min(max(time_s, 0.0) / SAMPLE_S, len(self._rows) - 1.0)
        index = min(int(place), len(self._rows) - 2)
        share = place - index
        way, x, y, heading, linear, angular = [
            a + share * (b - a) for a, b in zip(self._rows[index], self._rows[index + 1])]
        if time_s >= self.duration_s:
            linear = angular = 0.0
        return Reference(Pose2(x, y, wrap_angle(heading)), linear, angular, way)
