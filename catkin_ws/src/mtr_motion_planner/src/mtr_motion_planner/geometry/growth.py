"""Growth of the Car's reported outline, side by side, by the uncertainty of Car and robot."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Tuple

from shapely.affinity import translate
from shapely.geometry import Polygon
from shapely.ops import unary_union

from ..inputs import EstimatedCar, RobotState, SideSigmas
from ..parameters import Margins

# Number of sigmas by which each side of the Car is moved outwards. Without a data sheet the end of the Car is reported
# in the LiDARs' plane, with a sigma for which the true end is at most 2 sigma farther out.
MARGIN_SIGMAS = 2.0
# An end known this well may be approached more closely than invisible protrusions require.
KNOWN_SIGMA_M = 0.02


class Growth(NamedTuple):
    """Distances outwards in m, one for each side of the Car."""

    front: float = 0.0
    rear: float = 0.0
    left: float = 0.0
    right: float = 0.0

    def is_more_than(self, other: "Growth", by_m: float) -> bool:
        """Return True if a side has grown by more than this compared with the other."""
        return any(mine > theirs + by_m for mine, theirs in zip(self, other))


NO_GROWTH = Growth()


class CarBounds(NamedTuple):
    """Properties of the Car in addition to its outline.

    Attributes:
        growth: growth of each side by uncertainty.
        fittings: protrusions beyond the outline, as entered by the laboratory.
        front_is_known: the front may be approached more closely than protrusion_m.
        rear_is_known: the same for the rear.
        size: length and width of the Car, m; infinite if only its outline is known.
        own_sigma_m: the robot's own position in the 1 sigma of the growth.
    """

    growth: Growth = NO_GROWTH
    fittings: Growth = NO_GROWTH
    front_is_known: bool = True
    rear_is_known: bool = True
    size: Tuple[float, float] = (math.inf, math.inf)
    own_sigma_m: float = 0.0

    @property
    def total(self) -> Growth:
        """Distance by which each side of the outline moves outwards."""
        return Growth(*(sigma_m + fitting_m for sigma_m, fitting_m in zip(self.growth, self.fittings)))


EXACT_BOUNDS = CarBounds()


def bounds_of(car: EstimatedCar, robot: RobotState, reach_m: float, margins: Margins) -> CarBounds:
    """Return the bounds of a Car for the robot, whose key is reach_m ahead of the planned point.

    The prior outline of a Car that is not located has its own margin.
    """
    fittings = Growth(margins.front_fitting_m, margins.rear_fitting_m)
    if not car.located:
        return CarBounds(NO_GROWTH, fittings, front_is_known=False, rear_is_known=False)
    sigmas = sigmas_of(car, robot, reach_m)
    return CarBounds(Growth(*(MARGIN_SIGMAS * sigma_m for sigma_m in sigmas)), fittings,
                     sigmas.front <= KNOWN_SIGMA_M or fittings.front > 0.0,
                     sigmas.rear <= KNOWN_SIGMA_M or fittings.rear > 0.0, car.size, own_sigma_of(robot, reach_m))


def own_sigma_of(robot: RobotState, reach_m: float) -> float:
    """Return 1 sigma of the position of the robot's key, m."""
    return math.hypot(robot.position_sigma_m, reach_m * robot.heading_sigma)


def sigmas_of(car: EstimatedCar, robot: RobotState, reach_m: float) -> SideSigmas:
    """Return 1 sigma of the distance between the robot and each side of the Car, at the side's corners."""
    half_length, half_width = (max((abs(point[axis]) for point in car.outline), default=0.0) for axis in (0, 1))
    own_m = own_sigma_of(robot, reach_m)
    levers_m = (half_width, half_width, half_length, half_length)
    return SideSigmas(*(math.sqrt(sigma_m ** 2 + (lever_m * car.heading_sigma) ** 2 + own_m ** 2)
                        for sigma_m, lever_m in zip(car.sides, levers_m)))


def grown(polygon: Polygon, heading: float, by: Growth) -> Polygon:
    """Return the polygon with its sides moved outwards in the axes of the heading; if any moves, the convex hull."""
    if not any(by):
        return polygon
    return unary_union([translate(polygon, *_turned(x, y, heading)) for x in (by.front, -by.rear)
                        for y in (by.left, -by.right)]).convex_hull


def _turned(x: float, y: float, heading: float) -> Tuple[float, float]:
    cos, sin = math.cos(heading), math.sin(heading)
    return cos * x - sin * y, sin * x + cos * y
