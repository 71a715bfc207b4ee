"""How far beyond its reported outline the Car may be, side by side, by its own uncertainty and the robot's."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Tuple

from shapely.affinity import translate
from shapely.geometry import Polygon
from shapely.ops import unary_union

from ..inputs import EstimatedCar, RobotState, SideSigmas
from ..parameters import Margins

# The robot stays away from where a side of the Car may be within so many sigmas. An end without a data sheet is
# published where the LiDARs' plane meets it, and its sigma says that it lies farther out by twice as much at most.
MARGIN_SIGMAS = 2.0
# An end that is known this well may be approached more closely than what no LiDAR sees there requires.
KNOWN_SIGMA_M = 0.02


class Growth(NamedTuple):
    """Distances outwards in m, one for each side of the Car."""

    front: float = 0.0
    rear: float = 0.0
    left: float = 0.0
    right: float = 0.0

    def is_more_than(self, other: "Growth", by_m: float) -> bool:
        """True when a side has grown by more than that against the other."""
        return any(mine > theirs + by_m for mine, theirs in zip(self, other))


NO_GROWTH = Growth()


class CarBounds(NamedTuple):
    """What the robot has to know of the Car besides its outline.

    Attributes:
        growth: what uncertainty adds to each side.
        fittings: what stands out of the outline, as the laboratory has entered it.
        front_is_known: the front may be approached more closely than protrusion_m.
        rear_is_known: the same of the rear.
        size: length and width of the Car, m; infinite when only its outline is known.
        own_sigma_m: what of the growth's 1 sigma is the robot's own position.
    """

    growth: Growth = NO_GROWTH
    fittings: Growth = NO_GROWTH
    front_is_known: bool = True
    rear_is_known: bool = True
    size: Tuple[float, float] = (math.inf, math.inf)
    own_sigma_m: float = 0.0

    @property
    def total(self) -> Growth:
        """How far each side of the outline moves outwards."""
        return Growth(*(sigma_m + fitting_m for sigma_m, fitting_m in zip(self.growth, self.fittings)))


EXACT_BOUNDS = CarBounds()


def bounds_of(car: EstimatedCar, robot: RobotState, reach_m: float, margins: Margins) -> CarBounds:
    """Bounds of a Car for the robot, whose key is reach_m ahead of the point that is planned for.

    The prior outline of a Car that is not located has a margin of its own.
    """
    fittings = Growth(margins.front_fitting_m, margins.rear_fitting_m)
    if not car.located:
        return CarBounds(NO_GROWTH, fittings, front_is_known=False, rear_is_known=False)
    sigmas = sigmas_of(car, robot, reach_m)
    return CarBounds(Growth(*(MARGIN_SIGMAS * sigma_m for sigma_m in sigmas)), fittings,
                     sigmas.front <= KNOWN_SIGMA_M or fittings.front > 0.0,
                     sigmas.rear <= KNOWN_SIGMA_M or fittings.rear > 0.0, car.size, own_sigma_of(robot, reach_m))


def own_sigma_of(robot: RobotState, reach_m: float) -> float:
    """1 sigma of where the robot's key is, m."""
    return math.hypot(robot.position_sigma_m, reach_m * robot.heading_sigma)


def sigmas_of(car: EstimatedCar, robot: RobotState, reach_m: float) -> SideSigmas:
    """1 sigma of the distance between robot and each side of the Car, at the side's corners."""
    half_length, half_width = (max((abs(point[axis]) for point in car.outline), default=0.0) for axis in (0, 1))
    own_m = own_sigma_of(robot, reach_m)
    levers_m = (half_width, half_width, half_length, half_length)
    return SideSigmas(*(math.sqrt(sigma_m ** 2 + (lever_m * car.heading_sigma) ** 2 + own_m ** 2)
                        for sigma_m, lever_m in zip(car.sides, levers_m)))


def grown(polygon: Polygon, heading: float, by: Growth) -> Polygon:
    """The polygon with each side of the Car, whose heading it has, moved outwards; its convex hull when one is."""
    if not any(by):
        return polygon
    return unary_union([translate(polygon, *_turned(x, y, heading)) for x in (by.front, -by.rear)
                        for y in (by.left, -by.right)]).convex_hull


def _turned(x: float, y: float, heading: float) -> Tuple[float, float]:
    cos, sin = math.cos(heading), math.sin(heading)
    return cos * x - sin * y, sin * x + cos * y
