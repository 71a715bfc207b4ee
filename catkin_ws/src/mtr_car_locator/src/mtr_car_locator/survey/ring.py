"""Places around the Car from which all its sides are seen, and their order."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Tuple

from mtr_core.se2 import Pose2, wrap_angle

from ..rectangle import Rectangle


class Ring:
    """Eight places, two at each corner, and the first one again at the end, to close the loop.

    The order is fixed at construction; the places follow the improving estimate of the Car.
    """

    def __init__(self, robot: Pose2, car: Rectangle, distance_m: float):
        self._distance_m = distance_m
        start = car.pose.inverse() @ robot
        ways = _orders(start, _places(car, distance_m))
        self._left = min(ways, key=lambda order: self._first_turn(order, robot, car))
        self._passed: List[int] = []
        self._cannot_close = False

    @property
    def done(self) -> int:
        """Number of passed places."""
        return len(self._passed)

    @property
    def total(self) -> int:
        """Number of passed and remaining places."""
        return len(self._passed) + len(self._ahead)

    @property
    def is_finished(self) -> bool:
        """True if no reachable place remains."""
        return not self._ahead

    @property
    def _ahead(self) -> List[int]:
        first = self._passed[:1] or self._left[:1]
        is_closed = len(self._passed) + len(self._left) < 2 or (not self._left and self._passed[-1] == first[0])
        return self._left if is_closed or self._cannot_close else [*self._left, *first]

    def place(self, car: Rectangle) -> Pose2:
        """Return the pose in map of the next place, with the heading of the path from the previous place."""
        places = _places(car, self._distance_m)
        x, y = places[self._ahead[0]]
        back_x, back_y = places[self._before()]
        return car.pose @ Pose2(x, y, math.atan2(y - back_y, x - back_x))

    def places_ahead(self, car: Rectangle) -> Tuple[Pose2, ...]:
        """Return the remaining places in map; their headings have no meaning."""
        places = _places(car, self._distance_m)
        return tuple(car.pose @ Pose2(*places[index], 0.0) for index in self._ahead)

    def pass_place(self) -> None:
        """Mark the place as passed or given up."""
        self._passed.append(self._ahead[0])
        self._left = self._left[1:]

    def turn_back(self) -> None:
        """Give up a blocked place and visit the remaining ones the other way round."""
        self._cannot_close = not self._left
        self._left = self._left[:0:-1]

    def _before(self) -> int:
        return self._passed[-1] if self._passed else self._left[-1]

    def _first_turn(self, order: List[int], robot: Pose2, car: Rectangle) -> float:
        x, y = car.pose.apply(*_places(car, self._distance_m)[order[0]])
        return abs(wrap_angle(math.atan2(y - robot.y, x - robot.x) - robot.heading))


def _places(car: Rectangle, distance_m: float) -> List[Tuple[float, float]]:
    """Return the places counterclockwise in the Car's frame, from the left of the front."""
    x, y, d = 0.5 * car.length, 0.5 * car.width, distance_m
    return [(x + d, y), (x, y + d), (-x, y + d), (-x - d, y), (-x - d, -y), (-x, -y - d), (x, -y - d), (x + d, -y)]


def _orders(start: Pose2, places: List[Tuple[float, float]]) -> List[List[int]]:
    """Return indices of a circuit, counterclockwise and clockwise, starting with the place nearest to the start."""
    here = math.atan2(start.y, start.x)
    ahead = [math.remainder(math.atan2(y, x) - here, 2.0 * math.pi) % (2.0 * math.pi) for x, y in places]
    counterclockwise = sorted(range(len(places)), key=lambda k: ahead[k])
    return [counterclockwise, counterclockwise[::-1]]
