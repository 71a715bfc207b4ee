"""The Car as an obstacle in map: how close a footprint gets, where the robot may turn, where routes run."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Sequence

from shapely.geometry import LineString, MultiPoint, Point, Polygon

from mtr_core.se2 import Pose2

from .inputs import Car
from .inputs import Point as XY
from .parameters import MotionParameters

# Steps of a quarter circle: a chord's sagitta stays below 1 cm at the radii in use.
CORNER_STEPS = 4
# A line that only grazes a zone by less than this runs along its edge.
GRAZE_M = 0.01


class CarObstacle:
    """Convex hull of the Car's outline and the zones around it, all in map.

    Attributes:
        hull: polygon that the footprint must stay away from.
        turn_zone: where base_link must not be while the robot turns on the spot.
        route_zone: where base_link is not led by a route.
    """

    def __init__(self, car: Car, parameters: MotionParameters):
        radius = parameters.turn_radius_m
        self._half_length = 0.5 * parameters.footprint_length_m
        self._half_width = 0.5 * parameters.footprint_width_m
        self.hull = MultiPoint([car.pose.apply(x, y) for x, y in car.outline]).convex_hull
        self.turn_zone = self.hull.buffer(radius + parameters.turn_margin_m, CORNER_STEPS)
        self.route_zone = self.hull.buffer(radius + parameters.route_margin_m, CORNER_STEPS)
        self._turn_core = self.turn_zone.buffer(-GRAZE_M)
        self._route_core = self.route_zone.buffer(-GRAZE_M)

    def clearance(self, pose: Pose2) -> float:
        """Distance of the robot's footprint at the pose from the Car, 0 when they overlap."""
        return Polygon(self._corners(pose)).distance(self.hull)

    def swept_clearance(self, start: Pose2, end: Pose2) -> float:
        """Least distance of the footprint that slides from start to end."""
        return MultiPoint(self._corners(start) + self._corners(end)).convex_hull.distance(self.hull)

    def distance_of_point(self, pose: Pose2) -> float:
        """Distance of base_link from the Car."""
        return Point(pose.x, pose.y).distance(self.hull)

    def forbids_turn(self, pose: Pose2) -> bool:
        """True where the robot is too close to the Car to turn on the spot."""
        return self.turn_zone.contains(Point(pose.x, pose.y))

    def near_route_edge(self, pose: Pose2) -> bool:
        """True inside the zone that routes go around."""
        return self._route_core.contains(Point(pose.x, pose.y))

    def lets_pass(self, line: Sequence[XY]) -> bool:
        """True when base_link may follow the line turning as it likes."""
        return not LineString(line).intersects(self._turn_core)

    def blocks_route(self, line: Sequence[XY]) -> bool:
        """True when the line crosses the zone that routes go around."""
        return LineString(line).intersects(self._route_core)

    def _corners(self, pose: Pose2) -> List[XY]:
        ahead, aside = self._half_length, self._half_width
        return [pose.apply(x, y) for x, y in ((ahead, aside), (-ahead, aside), (-ahead, -aside), (ahead, -aside))]


def is_material_change(old: Car, new: Car, shift_m: float = 0.02, turn_rad: float = math.radians(0.5)) -> bool:
    """True when a plan made with the old Car should be made again."""
    if old.located != new.located or len(old.outline) != len(new.outline):
        return True
    if old.pose.distance_to(new.pose) > shift_m or abs((old.pose.inverse() @ new.pose).heading) > turn_rad:
        return True
    return any(math.hypot(a[0] - b[0], a[1] - b[1]) > shift_m for a, b in zip(old.outline, new.outline))
