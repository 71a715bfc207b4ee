"""Turns a candidate into motions with collision-free trajectories."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterator, List, Optional, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle

from ..geometry.curve import trace
from ..geometry.fence import Fence
from ..geometry.keep_out import ROUNDING_M, KeepOut
from ..geometry.route import facing, moved
from ..parameters import MotionParameters
from ..timing.blend import Blend, Turns, keeps, overlapped, overlaps_of
from ..timing.motion import CurveMotion, Pivot, PlannedMotion
from ..timing.plan import Moving, PlanPart
from ..timing.trajectory import Trajectory
from .candidates import MOVING_MPS, WayCandidate
from .options import StraightPiece
from .shaping import ATTEMPTS, CLOSE_M, Driving, Start, curve_of

# Away from start and goal a rounded corner may reduce the route's margin to this share.
CORNER_SHARE = 0.4
ENDS_M = 0.6
NO_TURN_RAD = 0.002
# Tried lengths of a stop, as shares of the shortest; on a tight curve, and by rounding, the stop is longer.
BRAKE_SHARES, BRAKE_M, BRAKE_RAD = (1.05, 1.4, 2.0, 3.0), 0.02, 0.02
# One in this many samples, every 60 ms, is checked for collisions.
CHECKED = 3

Begun = Tuple[PlannedMotion, float]  # with its start speed


class Assembly:
    """Plans motions for one Car, robot and speed limit.

    Attributes:
        blends_left: remaining attempts to overlap turns with drives; each needs some milliseconds.
    """

    def __init__(self, keep_out: KeepOut, fence: Optional[Fence], parameters: MotionParameters, speed: float):
        self._keep_out, self._fence, self._parameters, self._speed = keep_out, fence, parameters, speed
        self.blends_left = 0
        self._driving = Driving(parameters.limits, parameters.slip, speed)

    def work_out(self, candidate: WayCandidate, start: Moving, goal: Pose2, best_s: float = math.inf
                 ) -> Optional[List[PlanPart]]:
        """Return the parts of a candidate; None if its curve does not exist or is not free.

        best_s: time of the best plan so far; turns are only overlapped if the result can be quicker.
        """
        out, sign, into = candidate.out, candidate.sign, candidate.into
        before: List[Begun] = []
        after: List[Begun] = []
        begin, end = start, goal
        if out.sign and out.sign != sign:
            before = [(line(start.pose, out), out.sign * start.linear_mps)]
            begin = Moving(moved(start.pose, out.sign * out.length))
        if into.sign and into.sign != sign:
            end = moved(goal, -into.sign * into.length)
            after = [(line(end, into), 0.0)]
        transit = self._transit(candidate, begin, end)
        if transit is None:
            return None
        blends = self._blends(candidate, begin, end, transit, best_s) if len(transit) > 1 else ()
        for blend in blends:
            parts = self.timed([*before, (blend, 0.0), *after], start.pose)
            if parts:
                return parts
        return self.timed([*before, *transit, *after], start.pose)

    def _blends(self, candidate: WayCandidate, begin: Moving, end: Pose2, transit: List[Begun], best_s: float
                ) -> Iterator[Blend]:
        """Yield the transit with turns that overlap with the drive, the quickest first."""
        turns, slip = self._turns(transit), self._parameters.slip
        if turns is None:
            return
        for overlap_s in overlaps_of(turns, self._parameters.limits, slip):
            if self.blends_left == 0 or turns.duration_s - sum(overlap_s) >= best_s:
                return
            self.blends_left -= 1
            blend = self._blend(candidate, begin, end, overlap_s)
            if blend:
                yield blend

    def _blend(self, candidate: WayCandidate, begin: Moving, end: Pose2, overlap_s: Tuple[float, float]
               ) -> Optional[Blend]:
        """Shift start and aim of the drive by the distance that the overlaps add, until the blend ends as planned."""
        start, aim = begin.pose, end
        for _ in range(ATTEMPTS):
            transit = self._transit(candidate, Moving(start, begin.linear_mps, begin.angular_radps), aim)
            turns = None if transit is None else self._turns(transit)
            if transit is None or turns is None:
                return None
            trajectory, aside = overlapped(turns, overlap_s, self._parameters.slip,
                                           complex(begin.pose.x, begin.pose.y))
            if not keeps(trajectory, self._parameters.limits):
                return None
            x, y = trajectory.poses[-1, :2]
            if math.hypot(end.x - x, end.y - y) < CLOSE_M:
                return Blend(next(motion for motion, _ in transit if isinstance(motion, CurveMotion)), trajectory)
            # After the first turn the robot must be on the drive's own path, which keeps its distance from the Car.
            begun = Pose2(begin.pose.x + aside.real, begin.pose.y + aside.imag, begin.pose.heading)
            aim = Pose2(aim.x + end.x - x + begun.x - start.x, aim.y + end.y - y + begun.y - start.y, end.heading)
            start = begun
        return None

    def _turns(self, transit: List[Begun]) -> Optional[Turns]:
        """Return the trajectories; None if the robot is too fast to stop on the drive."""
        limits = self._parameters.limits
        middle = next(index for index, (motion, _) in enumerate(transit) if isinstance(motion, CurveMotion))
        first, drive, last = (motions[0][0].timed(limits, self._speed, max(motions[0][1], 0.0)) if motions else None
                              for motions in (transit[:middle], transit[middle:middle + 1], transit[middle + 1:]))
        return Turns(first, drive, last) if drive else None

    def _transit(self, candidate: WayCandidate, begin: Moving, end: Pose2) -> Optional[List[Begun]]:
        sign, shape = candidate.sign, candidate.shape
        speed = sign * begin.linear_mps if abs(begin.linear_mps) > MOVING_MPS else 0.0
        curvature = begin.angular_radps / speed if speed else 0.0
        curve = curve_of(shape, Start(facing(begin.pose, sign), speed, curvature), facing(end, sign),
                         self._driving)
        if curve is None:
            return None
        first, last = facing(curve.start, sign), facing(curve.end, sign)
        motions: List[Begun] = [(CurveMotion(curve, sign), speed)]
        if shape.first == 0.0:
            motions[:0] = pivot(begin.pose, first.heading)
        if shape.last == 0.0:
            motions += pivot(Pose2(end.x, end.y, last.heading), end.heading)
        return motions

    def timed(self, motions: Sequence[Begun], start: Pose2) -> Optional[List[PlanPart]]:
        """Return motions with trajectories; None if one is not free or cannot be driven from its start speed."""
        least_room = self._keep_out.least_room(start)
        total, done, parts = sum(motion.length_m for motion, _ in motions), 0.0, []
        for motion, speed in motions:
            trajectory = motion.timed(self._parameters.limits, self._speed, max(speed, 0.0))
            if trajectory is None or speed < -MOVING_MPS or not self._is_free(trajectory, least_room, done, total):
                return None
            done += motion.length_m
            parts.append(PlanPart(motion, trajectory))
        return parts

    def _is_free(self, trajectory: Trajectory, least_room: FloatArray, done: float, total: float) -> bool:
        poses, ways = trajectory.poses[::CHECKED], trajectory.ways[::CHECKED]
        along = done + (ways if trajectory.length_m else np.zeros(len(ways)))
        on_the_way = (along > ENDS_M) & (along < total - ENDS_M)
        margins = self._parameters.margins
        corner_room = np.maximum(least_room, (CORNER_SHARE * margins.route_margin_m - margins.keep_out_m, -ROUNDING_M))
        if (self._keep_out.room(poses) < np.where(on_the_way[:, None], corner_room, least_room)).any():
            return False
        return self._fence is None or self._fence.holds(poses, trajectory.linear[::CHECKED])

    def brake(self, start: Moving) -> PlanPart:
        """Stop on the present curve, or end the turn on the spot, within the shortest possible distance."""
        limits, speed, rate = self._parameters.limits, abs(start.linear_mps), abs(start.angular_radps)
        if speed <= MOVING_MPS:
            angle = limits.stopping_angle(rate)
            turns = (Pivot(start.pose, math.copysign(share * angle + BRAKE_RAD, start.angular_radps))
                     for share in BRAKE_SHARES)
            return next(PlanPart(turn, timed) for turn in turns for timed in [turn.timed(limits, 0.0, rate)] if timed)
        sign = 1 if start.linear_mps > 0.0 else -1
        bend = start.angular_radps / speed
        # If even the longest stop on the curve is too short, the straight one is not.
        curves = (trace(facing(start.pose, sign), [0.0, share * limits.stopping_distance(speed) + BRAKE_M], ends)
                  for ends in ([bend, 0.0], [0.0, 0.0]) for share in BRAKE_SHARES)
        stops = (CurveMotion(curve, sign) for curve in curves)
        return next(PlanPart(stop, timed) for stop in stops for timed in [stop.timed(limits, speed, speed)] if timed)


def line(start: Pose2, straight: StraightPiece) -> CurveMotion:
    """Return a straight motion from a pose of the robot."""
    return CurveMotion(trace(facing(start, straight.sign), [0.0, straight.length], [0.0, 0.0]), straight.sign)


def pivot(start: Pose2, heading: float) -> List[Begun]:
    """Return a turn on the spot to a heading; empty if none is needed."""
    turn = wrap_angle(heading - start.heading)
    return [(Pivot(start, turn), 0.0)] if abs(turn) > NO_TURN_RAD else []
