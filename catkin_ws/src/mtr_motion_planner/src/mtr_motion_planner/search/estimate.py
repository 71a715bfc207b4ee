"""A quick estimate of the duration of a route, to try the most promising routes first."""
# SPDX-License-Identifier: Apache-2.0
import math

from ..geometry.route import Leg, Route
from ..limits import MotionLimits
from .shaping import RouteShape

# Most turns on the spot can overlap with the drive by this time (blend.py).
OVERLAP_S = 1.5


def time_of(route: Route, shape: RouteShape, limits: MotionLimits, speed: float, start_speed: float) -> float:
    """Return the time in s from the start speed to rest, including turns on the spot."""
    total = limits.ramp_s
    entry = start_speed
    legs = route.legs
    corners = [_corner_speed(leg, limits, speed, index in (0, len(legs) - 1)) for index, leg in enumerate(legs)]
    for index, (leg, corner) in enumerate(zip(legs, corners)):
        if leg.radius == 0.0:
            total += max(0.0, limits.turn_time(leg.turn) - OVERLAP_S)
        else:
            total += leg.arc / max(corner, 1e-3)
            if entry == 0.0 or index + 1 == len(legs):
                total += corner / (2.0 * min(limits.acceleration_mps2,
                                             limits.angular_acceleration_radps2 * abs(leg.radius)))
            entry = corner
        if index + 1 < len(legs):
            leave = corners[index + 1]
            straight = leg.line + (shape.way_out if index == 0 else 0.0) + (
                shape.run_in if index + 2 == len(legs) else 0.0)
            total += _line_time(straight, entry, leave, speed, limits.acceleration_mps2)
            entry = leave
    return total


def _corner_speed(leg: Leg, limits: MotionLimits, speed: float, at_an_end: bool) -> float:
    if leg.radius == 0.0:
        return 0.0
    corner = min(speed, limits.corner_speed(1.0 / leg.radius))
    if not at_an_end:
        return corner
    # A short turn at an end cannot be stretched, because it has no straight line: its yaw rate builds up within the
    # turn.
    return min(corner, abs(leg.radius) * math.sqrt(limits.angular_acceleration_radps2 * max(abs(leg.turn), 0.01)))


def _line_time(length: float, entry: float, leave: float, speed: float, acceleration: float) -> float:
    """Return the time on a straight line between two speeds; a line that is too short is driven at their mean."""
    peak_square = acceleration * length + 0.5 * (entry ** 2 + leave ** 2)
    if peak_square <= max(entry, leave) ** 2:
        return 2.0 * length / max(entry + leave, 1e-3)
    peak_square = min(speed ** 2, peak_square)
    peak = math.sqrt(peak_square)
    rest = length - (2.0 * peak_square - entry ** 2 - leave ** 2) / (2.0 * acceleration)
    return (2.0 * peak - entry - leave) / acceleration + max(rest, 0.0) / peak
