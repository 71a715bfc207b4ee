"""Places around the Car from which all its sides are seen."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Tuple

from mtr_core.se2 import Pose2, wrap_angle

from .rectangle import Rectangle


class Ring:
    """Eight places, two at each corner, that go round the Car once from where the robot stands.

    The order is fixed when the ring is made; the places follow the Car as it gets known better.
    """

    def __init__(self, robot: Pose2, car: Rectangle, distance_m: float):
        self._distance_m = distance_m
        start = car.pose.inverse() @ robot
        ways = _orders(start, _places(car, distance_m))
        self._order = min(ways, key=lambda order: self._first_turn(order, robot, car))

    def __len__(self) -> int:
        return len(self._order)

    def place(self, index: int, car: Rectangle) -> Pose2:
        """Pose in map; the heading is that of the way from the place before."""
        places = _places(car, self._distance_m)
        x, y = places[self._order[index]]
        back_x, back_y = places[self._order[index - 1]]
        return car.pose @ Pose2(x, y, math.atan2(y - back_y, x - back_x))

    def _first_turn(self, order: List[int], robot: Pose2, car: Rectangle) -> float:
        x, y = car.pose.apply(*_places(car, self._distance_m)[order[0]])
        return abs(wrap_angle(math.atan2(y - robot.y, x - robot.x) - robot.heading))


def _places(car: Rectangle, distance_m: float) -> List[Tuple[float, float]]:
    """Counterclockwise in the Car's frame, from the front's left."""
    x, y, d = 0.5 * car.length, 0.5 * car.width, distance_m
    return [(x + d, y), (x, y + d), (-x, y + d), (-x - d, y), (-x - d, -y), (-x, -y - d), (x, -y - d), (x + d, -y)]


def _orders(start: Pose2, places: List[Tuple[float, float]]) -> List[List[int]]:
    """Indices once round, counterclockwise and clockwise, beginning with the place next to the start."""
    here = math.atan2(start.y, start.x)
    ahead = [math.remainder(math.atan2(y, x) - here, 2.0 * math.pi) % (2.0 * math.pi) for x, y in places]
    counterclockwise = sorted(range(len(places)), key=lambda k: ahead[k])
    return [counterclockwise, counterclockwise[::-1]]
