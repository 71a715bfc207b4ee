"""Places before the Car's corners, from each of which a long side and an end are seen."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List

from mtr_core.se2 import Pose2

from ..rectangle import Rectangle


def corners(car: Rectangle, distance_m: float) -> List[Pose2]:
    """Places in map before the four corners, counterclockwise from the front's left, that face the Car's centre."""
    reach = distance_m * math.sqrt(0.5)
    x, y = 0.5 * car.length + reach, 0.5 * car.width + reach
    return [car.pose @ Pose2(a, b, math.atan2(-b, -a)) for a, b in ((x, y), (-x, y), (-x, -y), (x, -y))]


def nearest(places: List[Pose2], robot: Pose2) -> int:
    """Index of the place next to the robot."""
    return min(range(len(places)), key=lambda index: places[index].distance_to(robot))
