"""Converts a route into a curve with continuous curvature and the same end."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import List, Optional, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle

from ..geometry.circles import circle_through
from ..geometry.curve import Curve, CurvePiece, breakpoints, merged, trace
from ..geometry.route import Route, TurnPolygon, around, moved, route_along
from ..limits import MotionLimits
from ..parameters import Slip
from ..timing.speeds import speeds_on

# Rounding the joints moves the end; the route is adjusted until the end is this close.
CLOSE_M, CLOSE_RAD = 0.001, 0.0005
ATTEMPTS = 8
# Two arcs of the same sense with a straight line shorter than this between them are driven as one.
MERGE_M = 0.25
# A straight line loses at most this share to the turn at one of its ends.
GIVEN_SHARE = 0.45
MAX_STRETCHED_RAD = 2.0
# Turns at the ends below this angle are widened, the smallest as if they had the minimum angle.
SMALL_TURN_RAD, MIN_TURN_RAD = 0.35, 0.002


@dataclass(frozen=True)
class Start:
    """Pose in the direction of travel, the speed there in m/s, and the curvature of the present curve in 1/m."""

    pose: Pose2
    speed: float = 0.0
    curvature: float = 0.0


@dataclass(frozen=True)
class RouteShape:
    """Shape of a route.

    Attributes:
        first, last: signed radii of the turns out of the start and into the end, m; 0: on the spot.
        way_out: straight segment before the first turn, m.
        run_in: straight segment after the last one, m.
        ring: polygon around which the route turns, None for a straight line from the first turn to the last.
        side: 1 for a route with the ring to its left.
    """

    first: float
    last: float
    way_out: float = 0.0
    run_in: float = 0.0
    ring: Optional[TurnPolygon] = None
    side: int = 1


def route_of(shape: RouteShape, start: Pose2, end: Pose2) -> Optional[Route]:
    """Return the route between two poses in the direction of travel."""
    begin, finish = moved(start, shape.way_out), moved(end, -shape.run_in)
    first, last = circle_through(begin, shape.first), circle_through(finish, shape.last)
    circles = around(first, last, shape.ring, shape.side) if shape.ring else [first, last]
    return None if circles is None else route_along(circles, begin.heading, finish.heading)


@dataclass(frozen=True)
class Driving:
    """Constraints of a drive along a curve.

    Attributes:
        speed: limit in m/s.
    """

    limits: MotionLimits
    slip: Slip
    speed: float


def curve_of(shape: RouteShape, start: Start, end: Pose2, driving: Driving) -> Optional[Curve]:
    """Return the smooth curve of the base, including its slip.

    With a turn on the spot at either end, the curve has its own heading there.
    """
    limits, speed, aim = driving.limits, driving.speed, end
    for _ in range(ATTEMPTS):
        route = route_of(shape, start.pose, aim)
        if route is None:
            return None
        shape = _gentle(shape, route, limits, speed)
        curve = _curve(shape, start, route, limits, speed)
        speeds = None if curve is None else speeds_on(curve, limits, speed, start.speed)
        if curve is None or speeds is None:
            return None
        curve = _slid(curve, np.asarray(speeds), driving.slip)
        miss = _miss(curve.end, end, turned_on_the_spot=shape.last == 0.0)
        if math.hypot(miss.x, miss.y) < CLOSE_M and abs(miss.heading) < CLOSE_RAD:
            return curve
        aim = Pose2(aim.x + miss.x, aim.y + miss.y, wrap_angle(aim.heading + miss.heading))
    return None


def _slid(curve: Curve, speeds: FloatArray, slip: Slip) -> Curve:
    curvature, squares = 0.5 * (curve.curvature[1:] + curve.curvature[:-1]), speeds ** 2
    outwards = slip.curve_slip_s2 * curvature * np.abs(curvature) * 0.5 * (squares[1:] + squares[:-1]) * curve.step_m
    return curve.slid(0.5 * slip.acceleration_slip_s2 * curvature * np.diff(squares) - outwards)


def _miss(reached: Pose2, aim: Pose2, turned_on_the_spot: bool) -> Pose2:
    heading = 0.0 if turned_on_the_spot else wrap_angle(aim.heading - reached.heading)
    return Pose2(aim.x - reached.x, aim.y - reached.y, heading)


def _curve(shape: RouteShape, start: Start, route: Route, limits: MotionLimits, speed: float) -> Optional[Curve]:
    turns = stretched(merged(_pieces(route), MERGE_M), limits, speed)
    pieces = merged([CurvePiece(0.0, shape.way_out), *turns, CurvePiece(0.0, shape.run_in)], gap_m=0.0)
    if not pieces:
        return None
    initial = start.curvature if start.speed > 0.0 else pieces[0].curvature
    return trace(_turned(start.pose, route), *breakpoints(pieces, _widths(pieces, initial, limits, speed), initial))


def _turned(pose: Pose2, route: Route) -> Pose2:
    first = route.legs[0]
    return pose if first.radius else Pose2(pose.x, pose.y, wrap_angle(pose.heading + first.turn))


def _pieces(route: Route) -> List[CurvePiece]:
    pieces = []
    for leg in route.legs:
        if leg.radius:
            pieces.append(CurvePiece(1.0 / leg.radius, leg.arc))
        pieces.append(CurvePiece(0.0, leg.line))
    return pieces


def _widths(pieces: Sequence[CurvePiece], initial: float, limits: MotionLimits, speed: float) -> Tuple[float, ...]:
    """Return the lengths of curvature changes at the start and at each joint, at the speed driven there."""
    curvatures = [initial, *(piece.curvature for piece in pieces)]
    widths = []
    for before, after in zip(curvatures, curvatures[1:]):
        driven = min(speed, limits.corner_speed(before), limits.corner_speed(after))
        widths.append(driven ** 2 * abs(after - before) / (0.85 * limits.angular_acceleration_radps2))
    return tuple(widths)


def stretched(pieces: Sequence[CurvePiece], limits: MotionLimits, speed: float) -> List[CurvePiece]:
    """Return the pieces with small turns between two straight lines made longer, at the expense of the lines.

    On a short arc the time is too short to build up a yaw rate and to reduce it; a longer arc is quicker.
    """
    longer = list(pieces)
    for i in range(1, len(pieces) - 1):
        before, piece, after = pieces[i - 1], pieces[i], pieces[i + 1]
        turn = abs(piece.curvature * piece.length)
        if piece.curvature == 0.0 or before.curvature or after.curvature or turn > MAX_STRETCHED_RAD:
            continue
        tangent = math.tan(0.5 * turn)
        radius = 2.0 * speed / math.sqrt(limits.angular_acceleration_radps2 * turn)
        more = min(radius - piece.length / turn, GIVEN_SHARE * min(before.length, after.length) / tangent)
        if more > 0.0:
            length = piece.length + more * turn
            longer[i - 1:i + 2] = [CurvePiece(0.0, longer[i - 1].length - more * tangent),
                                   CurvePiece(math.copysign(turn / length, piece.curvature), length),
                                   CurvePiece(0.0, longer[i + 1].length - more * tangent)]
    return longer


def _gentle(shape: RouteShape, route: Route, limits: MotionLimits, speed: float) -> RouteShape:
    """Widen small first and last turns, which start or end at rest if the robot is at rest there."""
    def radius(signed: float, turn: float) -> float:
        size = max(abs(turn), MIN_TURN_RAD)
        minimum = 2.0 * speed / math.sqrt(limits.angular_acceleration_radps2 * size)
        # From rest with full linear and angular acceleration: during the turn, length = a t^2 / 2.
        minimum = min(minimum, 4.0 * limits.acceleration_mps2 / limits.angular_acceleration_radps2)
        return math.copysign(max(abs(signed), minimum), signed) if signed and size < SMALL_TURN_RAD else signed

    return replace(shape, first=radius(shape.first, route.legs[0].turn), last=radius(shape.last, route.legs[-1].turn))
