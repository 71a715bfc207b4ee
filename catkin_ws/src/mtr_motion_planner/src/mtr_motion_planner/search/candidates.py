"""All reasonable paths from a start to a goal, the quickest by estimate first."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from dataclasses import dataclass
from typing import Iterator, List, Optional, Sequence, Tuple

from shapely.geometry import Point as ShapelyPoint

from mtr_core.se2 import Pose2

from ..geometry.keep_out import KeepOut, centres
from ..geometry.route import TurnPolygon, facing, moved
from ..limits import rest_to_rest_time
from ..parameters import MotionParameters
from ..timing.plan import Moving
from .estimate import time_of
from .options import StraightPiece, Target, arrivals, departures
from .shaping import RouteShape, route_of

# Radii of the turns at both ends in m, in addition to the radius at full speed. They match the simultaneous build-up of
# linear and angular acceleration from rest. Tighter turns are made while the robot starts to drive (blend.py).
TIGHT_RADII_M = (0.45,)
MAX_RING_M = 1.5
MOVING_MPS = 0.02
# A moving robot has no time to build up a high yaw rate in a short turn: its radii, as multiples of the radius at full
# speed.
MOVING_SHARES = (1.0, 2.0, 5.0)


@dataclass(frozen=True)
class WayCandidate:
    """A path: straight out (0: not needed), a shaped transit, straight in; sign -1: the rear leads in the transit."""

    time_s: float
    out: StraightPiece
    sign: int
    shape: RouteShape
    into: StraightPiece


class WayCandidates:
    """Generates candidates for one Car, robot and speed limit."""

    def __init__(self, keep_out: KeepOut, parameters: MotionParameters, speed: float):
        self._keep_out, self._parameters, self._speed = keep_out, parameters, speed
        cruise = parameters.limits.corner_radius(speed)
        self._radii = sorted({*(radius for radius in TIGHT_RADII_M if radius < 0.9 * cruise), cruise})
        gap = keep_out.route_gap_m
        sizes = {gap, min(MAX_RING_M, max(gap, cruise)), min(MAX_RING_M, max(gap, 0.6 * cruise))}
        self._rings, self._close_rings = ([TurnPolygon(centres(zone, size, gap), size) for size in sorted(sizes)]
                                          for zone in (keep_out.plain, keep_out.hull))

    def between(self, start: Moving, goal: Target) -> List[WayCandidate]:
        """Return the candidates, the quickest first; raises PlanRefused if start or goal is too close to the Car."""
        outs = departures(start.pose, self._keep_out)
        ins = arrivals(goal, self._keep_out, self._parameters)
        found = [candidate for out, into, sign in itertools.product(outs, ins, (1, -1))
                 for candidate in self._transits(start, goal.pose, out, into, sign)]
        return sorted(found, key=lambda candidate: candidate.time_s)

    def _transits(self, start: Moving, goal: Pose2, out: StraightPiece, into: StraightPiece, sign: int
                  ) -> Iterator[WayCandidate]:
        """Yield transits in one direction of travel; straight segments in the same direction are part of them."""
        speed = start.linear_mps
        moving = abs(speed) > MOVING_MPS
        if moving and speed * (out.sign or sign) < 0.0:
            return
        begin, finish = moved(start.pose, out.sign * out.length), moved(goal, -into.sign * into.length)
        joined_out, joined_in = out.sign == sign, into.sign == sign
        from_speed = abs(speed) if moving and (joined_out or not out.sign) else 0.0
        apart_s = sum(self._straight_time(piece) for piece in (out, into) if piece.sign and piece.sign != sign)
        lead, end = facing(start.pose if joined_out else begin, sign), facing(goal if joined_in else finish, sign)
        way_out, run_in = out.length if joined_out else 0.0, into.length if joined_in else 0.0
        turns = list(itertools.product(self._first_radii(from_speed, joined_out),
                                       self._signed_radii(on_the_spot=not joined_in)))
        for (ring, side), (first, last) in itertools.product(self._ways(begin, finish), turns):
            shape = RouteShape(first, last, way_out, run_in, ring, side)
            time_s = self._time(shape, lead, end, sign, from_speed)
            if time_s is not None:
                yield WayCandidate(time_s + apart_s, out, sign, shape, into)

    def _straight_time(self, piece: StraightPiece) -> float:
        limits = self._parameters.limits
        return rest_to_rest_time(piece.length, self._speed, limits.acceleration_mps2, limits.ramp_s)

    def _first_radii(self, from_speed: float, joined_out: bool) -> List[float]:
        if from_speed:
            return [share * radius for radius in (self._radii[-1], -self._radii[-1]) for share in MOVING_SHARES]
        return self._signed_radii(on_the_spot=not joined_out)

    def _time(self, shape: RouteShape, start: Pose2, end: Pose2, sign: int, from_speed: float) -> Optional[float]:
        route = route_of(shape, start, end)
        if route is None:
            return None
        length = sum(leg.arc + leg.line for leg in route.legs)
        if sign < 0 and length > self._parameters.longest_reverse_m:
            return None
        return time_of(route, shape, self._parameters.limits, self._speed, from_speed)

    def _ways(self, begin: Pose2, finish: Pose2) -> Sequence[Tuple[Optional[TurnPolygon], int]]:
        line = [(begin.x, begin.y), (finish.x, finish.y)]
        gap = min(self._keep_out.route_gap_m, self._keep_out.distance(begin), self._keep_out.distance(finish))
        if begin.distance_to(finish) < 1e-6 or not self._keep_out.crosses(line, gap):
            return [(None, 1)]
        is_near = any(self._keep_out.plain.distance(ShapelyPoint(pose.x, pose.y)) < self._keep_out.route_gap_m
                      for pose in (begin, finish))
        return list(itertools.product(self._close_rings if is_near else self._rings, (1, -1)))

    def _signed_radii(self, on_the_spot: bool) -> List[float]:
        return [*([0.0] if on_the_spot else []), *self._radii, *(-radius for radius in self._radii)]
