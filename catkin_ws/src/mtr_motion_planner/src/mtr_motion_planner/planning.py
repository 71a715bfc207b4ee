"""From start to goal without touching the Car: straight along the goal's axis if possible, else around."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional, Sequence, Tuple

from mtr_core.se2 import Pose2, wrap_angle
from mtr_core.states import Direction

from .obstacle import CarObstacle
from .parameters import MotionParameters
from .plan import Leg, Plan, PlanRefused, Route, Straight, Turn
from .route import length_of, route_between

# A goal is "straight ahead or behind" when heading and lateral offset are this close to its axis.
AXIS_HEADING_RAD = math.radians(15.0)
AXIS_OFFSET_PER_M = 0.15
AXIS_OFFSET_MAX_M = 0.30
# Within this distance a correction may go either way, whatever direction was asked for.
CORRECTION_M = 0.10
# Search of straight pieces out of and into the zone where the robot must not turn.
STEP_M = 0.05
LONGEST_STRAIGHT_OUT_M = 6.0
RUN_IN_M = 0.40
LEAST_CLEARANCE_M = 0.02
ROUNDING_M = 0.005


class Planning:
    """Plans for one Car and one robot."""

    def __init__(self, obstacle: CarObstacle, parameters: MotionParameters):
        self._obstacle = obstacle
        self._parameters = parameters

    def plan(self, start: Pose2, goal: Pose2, direction: Direction) -> Plan:
        """Legs from start to goal, both in map; PlanRefused when there are none."""
        self._check(start, goal)
        axis = self._along_axis(start, goal, direction)
        if axis:
            return Plan(goal, (axis, Turn(goal.heading)))
        legs: List[Leg] = []
        if self._obstacle.forbids_turn(start):
            leave = self._way_out(start)
            legs.append(leave)
            start = leave.end
        arrival, last = self._arrival(goal, direction)
        legs += self._transit(start, arrival, Direction.ANY if last else direction)
        return Plan(goal, tuple(legs + ([last, Turn(goal.heading)] if last else [])))

    def _check(self, start: Pose2, goal: Pose2) -> None:
        keep_out = self._parameters.keep_out_m
        left = self._obstacle.clearance(goal)
        if left < keep_out:
            raise PlanRefused(f"At the goal the robot would leave {left:.2f} m to the Car; at least {keep_out:.2f} m "
                              "must be left.")
        if self._obstacle.clearance(start) < LEAST_CLEARANCE_M:
            raise PlanRefused("The robot stands too close to the Car to plan; move it away by hand.")

    def _along_axis(self, start: Pose2, goal: Pose2, direction: Direction) -> Optional[Straight]:
        """The straight piece when the goal lies ahead or behind on the robot's own heading."""
        offset = goal.inverse() @ start
        reach = self._parameters.goal_across_m + AXIS_OFFSET_PER_M * abs(offset.x)
        if abs(offset.heading) > AXIS_HEADING_RAD or abs(offset.y) > min(reach, AXIS_OFFSET_MAX_M):
            return None
        sign = 1 if offset.x < 0.0 else -1
        wrong = Direction.BACKWARD if sign > 0 else Direction.FORWARD
        if direction == wrong and abs(offset.x) > CORRECTION_M:
            return None
        if self._obstacle.swept_clearance(start, goal) < self._least_on_the_way(start):
            return None
        return Straight((start.x, start.y), goal, sign)

    def _least_on_the_way(self, start: Pose2) -> float:
        return min(self._parameters.keep_out_m, self._obstacle.clearance(start)) - ROUNDING_M

    def _way_out(self, start: Pose2) -> Straight:
        """Shortest straight piece, backwards or forwards, to where the robot may turn."""
        least = self._least_on_the_way(start)
        for step in range(1, int(LONGEST_STRAIGHT_OUT_M / STEP_M)):
            for sign in (-1, 1):
                end = ahead_of(start, sign * step * STEP_M)
                if not self._obstacle.forbids_turn(end) and self._obstacle.swept_clearance(start, end) >= least:
                    return Straight((start.x, start.y), end, sign)
        raise PlanRefused("The robot stands so close to the Car that it cannot drive straight out; move it by hand.")

    def _arrival(self, goal: Pose2, direction: Direction) -> Tuple[Pose2, Optional[Straight]]:
        """Pose where the route ends, and the straight piece from there when the goal is close to the Car."""
        if not self._obstacle.near_route_edge(goal):
            return goal, None
        signs = {Direction.FORWARD: (1,), Direction.BACKWARD: (-1,), Direction.ANY: (1, -1)}[direction]
        for sign in signs:
            for step in range(1, int(LONGEST_STRAIGHT_OUT_M / STEP_M)):
                begin = ahead_of(goal, -sign * step * STEP_M)
                if self._obstacle.swept_clearance(begin, goal) < self._parameters.keep_out_m - ROUNDING_M:
                    break
                if not self._obstacle.near_route_edge(begin):
                    begin = ahead_of(begin, -sign * RUN_IN_M)
                    return begin, Straight((begin.x, begin.y), goal, sign)
        if self._obstacle.forbids_turn(goal):
            raise PlanRefused("No straight piece leads to the goal past the Car without getting too close to it.")
        return goal, None

    def _transit(self, start: Pose2, end: Pose2, direction: Direction) -> List[Leg]:
        points = route_between(start, end, self._obstacle)
        if length_of(points) < ROUNDING_M:
            return [Turn(end.heading)]
        return [Route(tuple(points), self._sign_of(points, start, end, direction)), Turn(end.heading)]

    def _sign_of(self, points: Sequence[Tuple[float, float]], start: Pose2, end: Pose2, direction: Direction) -> int:
        if direction != Direction.ANY:
            return 1 if direction == Direction.FORWARD else -1
        if length_of(points) > self._parameters.longest_reverse_route_m:
            return 1
        return 1 if turning(points, start, end, 1) <= turning(points, start, end, -1) else -1


def turning(points: Sequence[Tuple[float, float]], start: Pose2, end: Pose2, sign: int) -> float:
    """Radians that the robot turns before and after a route."""
    flip = 0.0 if sign > 0 else math.pi
    first = math.atan2(points[1][1] - points[0][1], points[1][0] - points[0][0]) + flip
    last = math.atan2(points[-1][1] - points[-2][1], points[-1][0] - points[-2][0]) + flip
    return abs(wrap_angle(first - start.heading)) + abs(wrap_angle(end.heading - last))


def ahead_of(pose: Pose2, distance: float) -> Pose2:
    """Pose moved along its own heading."""
    return pose @ Pose2(distance, 0.0, 0.0)
