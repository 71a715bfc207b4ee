"""A plan: pieces of motion, one after the other."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Tuple, Union

from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from .inputs import Point
from .route import length_of


class PlanRefused(RobotError):
    """There is no plan that the robot may follow; the text says why."""


@dataclass(frozen=True)
class Straight:
    """Drive along the heading of end until base_link is there; sign -1: backwards."""

    start: Point
    end: Pose2
    sign: int

    @property
    def points(self) -> Tuple[Point, ...]:
        """Polyline of base_link."""
        return self.start, (self.end.x, self.end.y)


@dataclass(frozen=True)
class Route:
    """Follow the polyline; sign -1: the rear leads."""

    points: Tuple[Point, ...]
    sign: int


@dataclass(frozen=True)
class Turn:
    """Turn on the spot to the heading in map."""

    heading: float

    @property
    def points(self) -> Tuple[Point, ...]:
        """Polyline of base_link: none."""
        return ()


Leg = Union[Straight, Route, Turn]


@dataclass(frozen=True)
class Plan:
    """Legs that lead to the goal, a pose in map."""

    goal: Pose2
    legs: Tuple[Leg, ...]

    @property
    def points(self) -> List[Point]:
        """Polyline of base_link over all legs."""
        return [point for leg in self.legs for point in leg.points]

    def length_after(self, index: int) -> float:
        """Length in m of the legs behind the one with the index."""
        return sum(length_of(leg.points) for leg in self.legs[index + 1:])
