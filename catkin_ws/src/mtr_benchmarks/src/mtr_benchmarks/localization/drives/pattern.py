"""Path of one drive around the Car: the loop for the map, then axes and radials as the scenarios drive them."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterator, List, NamedTuple, Optional, Tuple

from mtr_core.se2 import Pose2, wrap_angle
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.car_shape import CarShape

from .legs import CarryLeg, Leg, LiftLeg, PathLeg, Point, StandLeg, StraightLeg, TurnLeg, WanderLeg
from .random_car import FRONT, LEFT, REAR, RIGHT

ROBOT = shipped_robot()
LOOP_DISTANCE_M, LOOP_SPEED_MPS = 1.6, 0.5
TRANSFER_DISTANCE_M, TRANSFER_SPEED_MPS = 2.2, 0.8
AXIS_SPEED_MPS, RADIAL_SPEED_MPS = 0.5, 0.5
# Distances of the key from the Car.
AXIS_FAR_M, AXIS_NEAR_M = 2.5, 0.4
RADIAL_NEAR_M, RADIAL_STEP_M = 1.5, 1.0
STAND_FIRST_S, STAND_S, STAND_AFTER_LOOP_S = 2.0, 1.5, 4.0
START, LOOP, SETTLE, TRANSFER, AXIS, RADIAL, KIDNAP, WANDER, ABDUCT = (
    "start", "loop", "settle", "transfer", "axis", "radial", "kidnap", "wander", "abduct")
# Index of the first of the two places on the ring at each side.
CLOSED_PLACES = {FRONT: 7, LEFT: 1, REAR: 3, RIGHT: 5}
# The robot is moved away from the Car, which is on its left in the loop; then it is stopped, as the fail-safes require.
LIFTED = LiftLeg(-2.0, math.radians(20.0))
STAND_AFTER_LIFT_S = 20.0
# Duration of the drive after an abduction.
WANDER_AFTER_S = 25.0


class DrivePiece(NamedTuple):
    """One leg and its group. line_rad: direction of the axis or radial in frame car."""

    leg: Leg
    kind: str
    line_rad: float = 0.0


class DrivePlan(NamedTuple):
    """Plan of the drive after the loop.

    Attributes:
        axes_rad: directions in frame car.
        radials_rad: directions in frame car.
        reach_m: largest distance of the radials from the Car.
        endless: axes and radials are repeated.
        kidnap: instead of driving axes and radials, the robot is lifted and put down elsewhere.
        closed: side of the Car on which another one is parked; the robot drives to and fro around the other three.
        abducted_after_s: instead of driving axes, the robot wanders for this time, is carried away, and wanders on;
            None: no abduction.
    """

    axes_rad: Tuple[float, ...]
    radials_rad: Tuple[float, ...]
    reach_m: float
    endless: bool = False
    kidnap: bool = False
    abducted_after_s: Optional[float] = None
    closed: Optional[str] = None


def pieces(shape: CarShape, start: Pose2, plan: DrivePlan) -> Iterator[DrivePiece]:
    """Yield the legs from the start, a pose in frame car."""
    here = (start.x, start.y)
    yield DrivePiece(StandLeg(STAND_FIRST_S), START)
    for way in _loop_ways(shape, here, plan.closed):
        yield from (DrivePiece(TurnLeg(_bearing(here, way[0])), LOOP), DrivePiece(PathLeg(way, LOOP_SPEED_MPS), LOOP))
        here = way[-1]
    yield DrivePiece(StandLeg(STAND_AFTER_LOOP_S), SETTLE)
    if plan.kidnap:
        yield from (DrivePiece(LIFTED, KIDNAP), DrivePiece(StandLeg(STAND_AFTER_LIFT_S), KIDNAP))
        return
    if plan.abducted_after_s is not None:
        yield from (DrivePiece(WanderLeg(plan.abducted_after_s), WANDER), DrivePiece(CarryLeg(), ABDUCT),
                    DrivePiece(WanderLeg(WANDER_AFTER_S), ABDUCT))
        return
    again = True
    while again:
        for direction in plan.axes_rad:
            legs, here = _axis(shape, here, direction)
            yield from legs
        for direction in plan.radials_rad:
            legs, here = _radial(shape, here, direction, plan.reach_m)
            yield from legs
        again = plan.endless


def ring(shape: CarShape, distance_m: float) -> List[Point]:
    """Return two places at each corner, counterclockwise from the front's left, as in the Car locator's ring."""
    x, y, d = 0.5 * shape.length_m, 0.5 * shape.width_m, distance_m
    return [(x + d, y), (x, y + d), (-x, y + d), (-x - d, y), (-x - d, -y), (-x, -y - d), (x, -y - d), (x + d, -y)]


def edge(shape: CarShape, direction_rad: float) -> Point:
    """Return the beginning of an axis: the middle of a side if the axis is perpendicular to it, else the corner."""
    cos, sin = math.cos(direction_rad), math.sin(direction_rad)
    return (0.5 * shape.length_m * _sign(cos), 0.5 * shape.width_m * _sign(sin))


def outline_distance(shape: CarShape, direction_rad: float) -> float:
    """Return the distance from the Car's centre to its rectangular outline along a direction."""
    cos, sin = abs(math.cos(direction_rad)), abs(math.sin(direction_rad))
    return min(0.5 * shape.length_m / max(cos, 1e-9), 0.5 * shape.width_m / max(sin, 1e-9))


def _loop_ways(shape: CarShape, here: Point, closed: Optional[str]) -> List[Tuple[Point, ...]]:
    """Return the loop around the Car from the nearest place; with a closed side, drives to both of its ends and
    back."""
    places = ring(shape, LOOP_DISTANCE_M)
    if closed is not None:
        begin = CLOSED_PLACES[closed]
        places = [places[(begin + 2 + step) % len(places)] for step in range(len(places) - 2)]
    first = min(range(len(places)), key=lambda index: math.hypot(places[index][0] - here[0],
                                                                 places[index][1] - here[1]))
    if closed is None:
        return [tuple(places[(first + step) % len(places)] for step in range(len(places) + 1))]
    ways = [tuple(places[first:]), tuple(reversed(places[:-1])), tuple(places[1:first + 1])]
    return [way for way in ways if way]


def _axis(shape: CarShape, here: Point, direction: float) -> Tuple[List[DrivePiece], Point]:
    """Return the legs of an axis: approach, stop, backward retreat, stop."""
    x, y = edge(shape, direction)
    cos, sin = math.cos(direction), math.sin(direction)
    far, near = ((x + (distance + ROBOT.key.x_m) * cos, y + (distance + ROBOT.key.x_m) * sin)
                 for distance in (AXIS_FAR_M, AXIS_NEAR_M))
    legs: List[Leg] = [StraightLeg(near, AXIS_SPEED_MPS), StandLeg(STAND_S),
                       StraightLeg(far, AXIS_SPEED_MPS, True), StandLeg(STAND_S)]
    return [*_transfer(shape, here, far, wrap_angle(direction + math.pi)),
            *(DrivePiece(leg, AXIS, direction) for leg in legs)], far


def _radial(shape: CarShape, here: Point, direction: float, reach_m: float) -> Tuple[List[DrivePiece], Point]:
    """Return the legs of a radial: backward retreat facing the Car's centre with a stop at each step, then the
    return."""
    begin = outline_distance(shape, direction)
    cos, sin = math.cos(direction), math.sin(direction)
    steps = math.ceil((reach_m - RADIAL_NEAR_M) / RADIAL_STEP_M)
    distances = [*(begin + RADIAL_NEAR_M + step * RADIAL_STEP_M for step in range(steps)), begin + reach_m]
    stops = [(distance * cos, distance * sin) for distance in distances]
    legs: List[Leg] = [StandLeg(STAND_S)]
    for stop in stops[1:]:
        legs += [StraightLeg(stop, RADIAL_SPEED_MPS, True), StandLeg(STAND_S)]
    back = ((begin + TRANSFER_DISTANCE_M) * cos, (begin + TRANSFER_DISTANCE_M) * sin)
    return [*_transfer(shape, here, stops[0], wrap_angle(direction + math.pi)),
            *(DrivePiece(leg, RADIAL, direction) for leg in legs),
            DrivePiece(StraightLeg(back, TRANSFER_SPEED_MPS), TRANSFER)], back


def _transfer(shape: CarShape, here: Point, there: Point, heading: float) -> List[DrivePiece]:
    """Return the legs of the shorter path around the Car and of the final turn."""
    places = ring(shape, TRANSFER_DISTANCE_M)
    begin, end = (math.atan2(y, x) for x, y in (here, there))
    turn = wrap_angle(end - begin)
    turns = [(wrap_angle(math.atan2(y, x) - begin), (x, y)) for x, y in places]
    between = [(abs(angle), place) for angle, place in turns if angle * turn > 0.0 and abs(angle) < abs(turn)]
    way = (*(place for _, place in sorted(between)), there)
    legs = (TurnLeg(_bearing(here, way[0])), PathLeg(way, TRANSFER_SPEED_MPS), TurnLeg(heading))
    return [DrivePiece(leg, TRANSFER) for leg in legs]


def _bearing(here: Point, there: Point) -> float:
    return math.atan2(there[1] - here[1], there[0] - here[0])


def _sign(value: float) -> float:
    """Return -1, 0 or 1; values near 0 count as 0, because directions are rounded multiples of an eighth of a turn."""
    return 0.0 if abs(value) < 1e-6 else math.copysign(1.0, value)
