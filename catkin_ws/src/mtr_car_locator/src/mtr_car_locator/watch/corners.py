"""Observation places at the Car's corners, each with a view of a long side and an end."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List

from mtr_core.se2 import Pose2

from ..rectangle import Rectangle


def corners(car: Rectangle, distance_m: float) -> List[Pose2]:
    """Return places in map at the four corners, counterclockwise from the front left, facing the Car's centre."""
    reach = distance_m * math.sqrt(0.5)
    x, y = 0.5 * car.length + reach, 0.5 * car.width + reach
    return [car.pose @ Pose2(a, b, math.atan2(-b, -a)) for a, b in ((x, y), (-x, y), (-x, -y), (x, -y))]


def nearest(places: List[Pose2], robot: Pose2) -> int:
    """Return the index of the place nearest to the robot."""
    return min(range(len(places)), key=lambda index: places[index].distance_to(robot))
