"""Cables on the ground and their effect on a rigid wheel."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

from mtr_core.se2 import Pose2


@dataclass(frozen=True)
class Cable:
    """Straight round cable along the x axis of its pose in world; the pose is at its middle."""

    pose: Pose2
    diameter_m: float = 0.015
    length_m: float = 4.0


class Cables:
    """Height of the lowest point of a rigid wheel above level ground while it rolls over cables.

    The wheel touches a cable ahead of its own lowest point, so the height follows from a circle on a circle.
    """

    def __init__(self, cables: Sequence[Cable], wheel_radius_m: float):
        self._cables: List[Tuple[Pose2, float, float]] = [
            (cable.pose.inverse(), 0.5 * cable.length_m, 0.5 * cable.diameter_m) for cable in cables]
        self._wheel_m = wheel_radius_m

    def at(self, x_m: float, y_m: float) -> Tuple[float, float, float]:
        """Return the height at a place in world, and its slopes along x and y."""
        for from_world, half_m, radius_m in self._cables:
            along, across = from_world.apply(x_m, y_m)
            reach_m = 2.0 * math.sqrt(self._wheel_m * radius_m)
            if abs(along) <= half_m and abs(across) < reach_m:
                centre_m = math.sqrt((self._wheel_m + radius_m) ** 2 - across * across)
                rise = -across / centre_m
                heading = -from_world.heading
                return (centre_m + radius_m - self._wheel_m, -rise * math.sin(heading), rise * math.cos(heading))
        return 0.0, 0.0, 0.0
