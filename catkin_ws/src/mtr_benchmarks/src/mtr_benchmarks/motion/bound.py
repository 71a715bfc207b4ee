"""Lower bound of the time from one pose to another for a differential drive with limited motion.

The bound is the largest of three times. Each of them ignores effects that would make the motion slower.

turning     The heading changes at least by the angle between the poses. The time for this angle follows from the
            limits of yaw rate, angular acceleration and angular jerk, from rest to rest.
travelling  base_link stays at least (half the width + margin) away from the Car's hull, because the footprint contains
            a circle of that radius without the margin. Let L be the length of the shortest such path. The robot moves
            only along its heading, so the remaining distance shrinks at most with speed times the cosine of the angle
            between heading and path.
            At time t after the start the speed is at most S(t), the jerk-limited S-curve from rest. Before the end at
            time T it is at most S(T - t). At the start the heading differs from the path by an angle, of which at most
            P(t) has been turned; P is the quickest turn from rest. The same holds backwards from the end. Lateral
            displacement only turns the remaining path further away from the heading.
            So T is at least the shortest time with

                integral over 0..T of  min(S(t), S(T-t)) * cos(remaining angle at the start, at the end)  >=  L.

            The angle counts from the front or the rear, whichever is nearer. Curvature limits at corners, lateral
            acceleration, and the detour of turning while moving are ignored.
turning     A robot that starts with its front ahead and ends with its rear ahead, or vice versa, must also turn around
around      in between; see turning_bound.py.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np
from shapely.geometry import LineString, MultiPoint, Polygon
from shapely.geometry import Point as ShapelyPoint

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle
from mtr_motion_planner.limits import MotionLimits, rest_to_rest_time

from .turning_bound import TurningBound

Point = Tuple[float, float]
STEP_S = 0.01
MAX_DURATION_S = 120.0
ROUND_STEPS = 32


@dataclass(frozen=True)
class Ends:
    """Poses at the beginning and at the end of the motion, both at rest."""

    start: Pose2
    end: Pose2


def lower_bound(ends: Ends, hull: Polygon, gap_m: float, limits: MotionLimits, speed: float) -> float:
    """Return the bound in s; base_link stays gap_m away from the hull."""
    start, end = ends.start, ends.end
    speed = min(speed, limits.max_linear_mps)
    gap = min(gap_m, *(hull.distance(ShapelyPoint(pose.x, pose.y)) for pose in (start, end))) - 1e-3
    way = shortest_way((start.x, start.y), (end.x, end.y), hull.buffer(max(gap, 0.0), ROUND_STEPS))
    turn = abs(wrap_angle(end.heading - start.heading))
    turning = rest_to_rest_time(turn, limits.max_angular_radps, limits.angular_acceleration_radps2,
                                limits.angular_ramp_s)
    first, last = _direction(way[0], way[1]), _direction(way[-2], way[-1])
    bends = sum(wrap_angle(_direction(b, c) - _direction(a, b)) for a, b, c in zip(way, way[1:], way[2:]))
    grid_s = TurningBound(limits, speed).time(length_of(way), start.heading - first, end.heading - last, bends)
    return max(turning, grid_s, travelling(way, start.heading, end.heading, limits, speed))


def _direction(a: Point, b: Point) -> float:
    return math.atan2(b[1] - a[1], b[0] - a[0])


def shortest_way(start: Point, end: Point, zone: Polygon) -> List[Point]:
    """Return the shortest polyline around a convex zone; both ends are outside of it."""
    if not LineString([start, end]).crosses(zone):
        return [start, end]
    ring = list(MultiPoint([*zone.exterior.coords, start, end]).convex_hull.exterior.coords)[:-1]
    first, last = (_nearest(ring, point) for point in (start, end))
    ahead = [ring[(first + k) % len(ring)] for k in range((last - first) % len(ring) + 1)]
    back = [ring[(first - k) % len(ring)] for k in range((first - last) % len(ring) + 1)]
    return min(ahead, back, key=length_of)


def _nearest(ring: Sequence[Point], point: Point) -> int:
    """Return the index of the corner that is nearest to a point."""
    return min(range(len(ring)), key=lambda index: math.dist(ring[index], point))


def length_of(points: Sequence[Point]) -> float:
    """Return the length of a polyline."""
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def travelling(way: Sequence[Point], first_heading: float, last_heading: float, limits: MotionLimits, speed: float
               ) -> float:
    """Return the shortest T of the integral above."""
    length = length_of(way)
    if length < 1e-6:
        return 0.0
    off_start = _off(first_heading, way[0], way[1])
    off_end = _off(last_heading, way[-2], way[-1])
    times = np.arange(0.0, MAX_DURATION_S, STEP_S)
    speeds = _from_rest(times, speed, limits.acceleration_mps2, limits.ramp_s)
    rates = _from_rest(times, limits.max_angular_radps, limits.angular_acceleration_radps2, limits.angular_ramp_s)
    turned = np.concatenate(([0.0], np.cumsum(0.5 * (rates[1:] + rates[:-1]) * STEP_S)))
    at_start, at_end = (np.maximum(0.0, off - turned) for off in (off_start, off_end))
    low, high = 1, len(times)
    while high - low > 1:
        middle = (low + high) // 2
        off = np.maximum(at_start[:middle], at_end[:middle][::-1])
        gone = float(np.sum(np.minimum(speeds[:middle], speeds[:middle][::-1]) * np.cos(off))) * STEP_S
        low, high = (low, middle) if gone >= length else (middle, high)
    return float(times[low])


def _off(heading: float, a: Point, b: Point) -> float:
    """Return the angle between the robot's axis and the path."""
    angle = abs(wrap_angle(_direction(a, b) - heading))
    return min(angle, math.pi - angle)


def _from_rest(times: FloatArray, limit: float, acceleration: float, ramp_s: float) -> FloatArray:
    """Return the highest speeds from rest: the acceleration builds up within the ramp and is reduced within it."""
    jerk = acceleration / ramp_s
    peak = min(acceleration, math.sqrt(limit * jerk))
    ramp = peak / jerk
    hold = max(0.0, limit / peak - ramp)
    first = 0.5 * jerk * np.minimum(times, ramp) ** 2
    middle = peak * np.clip(times - ramp, 0.0, hold)
    late = np.clip(times - ramp - hold, 0.0, ramp)
    return np.minimum(limit, first + middle + peak * late - 0.5 * jerk * late ** 2)
