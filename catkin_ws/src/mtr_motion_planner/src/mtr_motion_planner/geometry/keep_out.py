"""The Car's outline as an area to avoid, for the robot's true footprint at poses of its turn centre."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterator, List, Optional, Sequence, Tuple

import numpy as np
from shapely.geometry import LineString, MultiPoint, Polygon
from shapely.geometry import Point as ShapelyPoint
from shapely.geometry.polygon import orient

from mtr_core.arrays import FloatArray
from mtr_core.problems import ProblemError
from mtr_core.se2 import Pose2

from .. import problems
from ..inputs import Point
from ..parameters import Margins
from .growth import EXACT_BOUNDS, CarBounds, Growth, grown
from .robot_outline import RobotOutline

# Sampling of the outline; for a footprint at a distance of 0.1 m the distance is at most 2 mm too large.
OUTLINE_STEP_M = 0.04
MIN_AREA_M2 = 0.05
# A line that enters a zone by less than this counts as running along its edge.
GRAZE_M = 0.005
# A plan may fall below a required distance by this much.
ROUNDING_M = 0.005
# Part of mirror_m and protrusion_m beyond the largest protrusion of a Car, for errors of control and small sigmas.
CONTROL_M = 0.02
FRAME = Pose2(0.0, 0.0, 0.0)
CORNERS = ((1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0))
# A robot that points at an end within 60 degrees approaches it; a robot that passes or turns there does not.
APPROACH_COSINE = 0.5
# A shorter side is replaced by a corner that is at most CORNER_MARGIN_M away from the hull.
SHORT_SIDE_M, CORNER_MARGIN_M = 1.0, 0.3


class OutlineUnusable(ProblemError):
    """The outline is not a polygon that a path can surround."""


class KeepOut:
    """The Car in the frame of the plan.

    Attributes:
        robot: the robot that avoids the Car.
        bounds: uncertainty and protrusions of the Car.
        told: the reported outline.
        outline: the reported outline, grown by its bounds.
        hull: convex hull of the grown outline.
        plain: polygon around the hull with few corners.
    """

    def __init__(self, outline: Sequence[Point], robot: RobotOutline, margins: Margins, car: Pose2 = FRAME,
                 bounds: CarBounds = EXACT_BOUNDS):
        """outline and car, the Car's pose, are in the frame of the plan."""
        self._margins, self._car = margins, car
        self.robot, self.bounds = robot, bounds
        self.told = polygon_of(outline)
        self.outline = grown(self.told, car.heading, bounds.total)
        self.hull: Polygon = orient(self.outline.convex_hull)
        self.plain: Polygon = plain_of(self.hull)
        self._edge = _sampled(self.outline)
        self._body_in_car = self._body()
        # Required gaps of the key from the grown outline, by side.
        self._required = self._required_gaps()
        self._turning = grown(self.hull, car.heading, Growth(*(
            max(0.0, robot.front_m + gap_m - self.pivot_gap_m) for gap_m in self._required)))

    def _body(self) -> Tuple[FloatArray, FloatArray]:
        """Return the edge of the grown body in the Car's frame. Points beyond the Car's size in the LiDARs' plane, such
        as noise and a tow bar, are omitted: mirror_m and protrusion_m refer to the size."""
        length, width = self.bounds.size
        inside = self.told
        if math.isfinite(length + width):
            rectangle = Polygon([self._car.apply(0.5 * x * length, 0.5 * y * width) for x, y in CORNERS])
            inside = self.told.intersection(rectangle)
        if not isinstance(inside, Polygon) or inside.is_empty:
            inside = self.told
        return _in_axes(self._car, *_sampled(grown(inside, self._car.heading, self.bounds.total)))

    def _required_gaps(self) -> Growth:
        """Return the required gaps by side; an end with an entered fitting has no other protrusion."""
        margins, growth = self._margins, self.bounds.growth
        ends = (margins.keep_out_m if fitting_m else margins.protrusion_m - min(CONTROL_M, growth_m)
                for growth_m, fitting_m in zip(growth[:2], self.bounds.fittings))
        return Growth(*ends, *(margins.mirror_m - min(CONTROL_M, growth_m) for growth_m in growth[2:]))

    def without_growth(self) -> "KeepOut":
        """Return the same Car without uncertainty."""
        return KeepOut(list(self.told.exterior.coords)[:-1], self.robot, self._margins, self._car,
                       CarBounds(fittings=self.bounds.fittings, size=self.bounds.size))

    @property
    def least_clearance_m(self) -> float:
        """Least planned distance of the footprint from the grown outline."""
        return self._margins.keep_out_m

    @property
    def pivot_gap_m(self) -> float:
        """Distance of the turn centre from the Car that a turn on the spot requires."""
        return self.robot.radius_m + self._margins.keep_out_m

    @property
    def route_gap_m(self) -> float:
        """Distance of the turn centre from the Car on the route around it, where the key can only turn away."""
        return max(self.robot.half_width_m + self._margins.route_margin_m, self.pivot_gap_m + 0.02)

    def clearances(self, poses: FloatArray) -> FloatArray:
        """Return the footprint's distance from the outline at each pose (rows of x, y, heading); 0 if they overlap."""
        cos, sin = np.cos(poses[:, 2:3]), np.sin(poses[:, 2:3])
        dx, dy = self._edge[0] - poses[:, 0:1], self._edge[1] - poses[:, 1:2]
        along = cos * dx + sin * dy
        ahead = np.maximum(np.maximum(along - self.robot.front_m, -along - self.robot.rear_m), 0.0)
        aside = np.maximum(np.abs(cos * dy - sin * dx) - self.robot.half_width_m, 0.0)
        return np.sqrt((ahead * ahead + aside * aside).min(axis=1))

    def gaps_beyond(self, pose: Pose2) -> Growth:
        """Return the key's distance beyond the line of each side of the grown body; negative on the Car's side."""
        x, y = _in_axes(self._car, *(np.array(value) for value in self.robot_front(pose)))
        along, across = self._body_in_car
        return Growth(float(x - along.max()), float(along.min() - x), float(y - across.max()), float(across.min() - y))

    def robot_front(self, pose: Pose2) -> Point:
        """Return the position of the key's front."""
        return pose.apply(self.robot.front_m, 0.0)

    def key_room(self, poses: FloatArray) -> FloatArray:
        """Return the key's distance from the Car's side or end in front of it minus the required one, at each pose."""
        front_m, cos, sin = self.robot.front_m, np.cos(poses[:, 2]), np.sin(poses[:, 2])
        x, y = _in_axes(self._car, poses[:, 0] + front_m * cos, poses[:, 1] + front_m * sin)
        along, across = self._body_in_car[0] - x[:, None], self._body_in_car[1] - y[:, None]
        beside = np.where(np.abs(along) <= OUTLINE_STEP_M, np.abs(across), np.inf).min(axis=1)
        before = np.where(np.abs(across) <= OUTLINE_STEP_M, np.abs(along), np.inf).min(axis=1)
        required = np.where(y > 0.0, self._required.left, self._required.right)
        return np.minimum(beside - required, before - self._required_before(x, poses[:, 2]))

    def _required_before(self, x: FloatArray, headings: FloatArray) -> FloatArray:
        """Return the required gap of a key at x of the Car from the nearest end, by the robot's heading."""
        is_ahead, forward = x > 0.0, np.cos(headings - self._car.heading)
        is_approach = np.where(is_ahead, self.bounds.front_is_known & (forward < -APPROACH_COSINE),
                               self.bounds.rear_is_known & (forward > APPROACH_COSINE))
        required = np.where(is_ahead, self._required.front, self._required.rear)
        return np.where(is_approach, np.minimum(required, self._margins.keep_out_m), required)

    def room(self, poses: FloatArray) -> FloatArray:
        """Return distances of footprint and key (columns) from the Car minus the required ones; negative: too close."""
        clearances = self.clearances(poses)
        # The key is part of the footprint, so its distance is at least the footprint's.
        widest_m = max(self._margins.mirror_m, self._margins.protrusion_m)
        key_room, is_close = np.full_like(clearances, np.inf), clearances < widest_m
        key_room[is_close] = self.key_room(poses[is_close])
        return np.column_stack((clearances - self._margins.keep_out_m, key_room))

    def least_room(self, start: Pose2) -> FloatArray:
        """Return the room that a path must keep: a start with too little room must not be followed by less."""
        return np.minimum(self.room(rows_of(start))[0], 0.0) - ROUNDING_M

    def clearance(self, pose: Pose2) -> float:
        """Return the distance of the footprint from the outline, 0 inside it."""
        if self.outline.contains(ShapelyPoint(pose.x, pose.y)):
            return 0.0
        return float(self.clearances(rows_of(pose))[0])

    def distance(self, pose: Pose2) -> float:
        """Return the distance of the turn centre from the hull."""
        return float(self.hull.distance(ShapelyPoint(pose.x, pose.y)))

    def turn_distance(self, pose: Pose2) -> float:
        """Return the distance of the turn centre from the hull, less the extra room of the key in a turn."""
        return float(self._turning.distance(ShapelyPoint(pose.x, pose.y)))

    def crosses(self, line: Sequence[Point], gap_m: float) -> bool:
        """Return True if the turn centre would come closer to the hull than the gap on the line."""
        return bool(self.hull.distance(LineString(line)) < gap_m - GRAZE_M)


def rows_of(pose: Pose2) -> FloatArray:
    """One row of x, y, heading."""
    return np.array([[pose.x, pose.y, pose.heading]])


def _in_axes(frame: Pose2, x: FloatArray, y: FloatArray) -> Tuple[FloatArray, FloatArray]:
    """Return coordinates of points as seen from a pose."""
    cos, sin, dx, dy = math.cos(frame.heading), math.sin(frame.heading), x - frame.x, y - frame.y
    return cos * dx + sin * dy, cos * dy - sin * dx


def centres(zone: Polygon, radius: float, gap_m: float) -> List[Point]:
    """Return a counterclockwise polygon that, grown by the radius, covers the convex zone grown by the gap.

    Each corner of the zone moves inwards on its bisector by radius - gap, so that it stays within that distance of the
    new polygon. No bend of the grown polygon is tighter than the radius.
    """
    corners = list(zone.exterior.coords)[:-1]
    inset = radius - gap_m
    moved = [_inwards(corners[i - 1], corner, corners[(i + 1) % len(corners)], inset)
             for i, corner in enumerate(corners)]
    core = MultiPoint(moved).convex_hull
    if not isinstance(core, Polygon):
        core = MultiPoint(corners).convex_hull.buffer(-0.1 * gap_m)
    return list(orient(core).exterior.coords)[:-1]


def plain_of(hull: Polygon) -> Polygon:
    """Return the counterclockwise hull with corners in place of its short sides, the shortest first.

    A measured Car has round corners. A path with one bend at each is quicker than one that bends at every corner of the
    outline.
    """
    corners = list(hull.exterior.coords)[:-1]
    while True:
        found = next(_corners_for_short_sides(corners, hull), None)
        if found is None:
            return Polygon(corners)
        index, corner = found
        corners[index] = corner
        del corners[(index + 1) % len(corners)]


def _corners_for_short_sides(corners: Sequence[Point], hull: Polygon) -> Iterator[Tuple[int, Point]]:
    count = len(corners)
    lengths = [math.dist(corner, corners[(i + 1) % count]) for i, corner in enumerate(corners)]
    for i in sorted(range(count), key=lengths.__getitem__):
        if lengths[i] < SHORT_SIDE_M:
            corner = _meeting(*(corners[(i + k) % count] for k in (-1, 0, 1, 2)))
            if corner and hull.distance(ShapelyPoint(corner)) <= CORNER_MARGIN_M:
                yield i, corner


def _meeting(before: Point, first: Point, last: Point, after: Point) -> Optional[Point]:
    """Return the intersection of two sides without the side between first and last, or None."""
    ax, ay, bx, by = first[0] - before[0], first[1] - before[1], last[0] - after[0], last[1] - after[1]
    cross = bx * ay - by * ax
    if cross <= 0.0:
        return None
    along = (bx * (last[1] - first[1]) - by * (last[0] - first[0])) / cross
    return first[0] + along * ax, first[1] + along * ay


def polygon_of(points: Sequence[Point]) -> Polygon:
    """Return a simple polygon with a plausible size of a Car; raises OutlineUnusable with the cause."""
    if len(points) < 3:
        raise OutlineUnusable(problems.OUTLINE_UNKNOWN())
    polygon = Polygon(points)
    # Collinear points are an invalid polygon too; the hull distinguishes them from a self-intersecting one.
    if polygon.convex_hull.area < MIN_AREA_M2:
        raise OutlineUnusable(problems.OUTLINE_WITHOUT_SIZE())
    if not polygon.is_valid:
        raise OutlineUnusable(problems.OUTLINE_CROSSED())
    return polygon


def _sampled(polygon: Polygon) -> Tuple[FloatArray, FloatArray]:
    corners = np.asarray(polygon.exterior.coords)
    parts = []
    for a, b in zip(corners, corners[1:]):
        steps = max(1, math.ceil(float(np.hypot(*(b - a))) / OUTLINE_STEP_M))
        parts.append(a + (b - a) * np.linspace(0.0, 1.0, steps, endpoint=False)[:, None])
    points = np.concatenate(parts)
    return points[:, 0], points[:, 1]


def _inwards(before: Point, corner: Point, after: Point, distance: float) -> Point:
    """The corner of a counterclockwise polygon moved on its bisector."""
    if distance <= 0.0:
        return corner
    first = math.atan2(corner[1] - before[1], corner[0] - before[0])
    turn = math.remainder(math.atan2(after[1] - corner[1], after[0] - corner[0]) - first, 2.0 * math.pi)
    bisector = first + 0.5 * (math.pi + turn)
    return corner[0] + distance * math.cos(bisector), corner[1] + distance * math.sin(bisector)
