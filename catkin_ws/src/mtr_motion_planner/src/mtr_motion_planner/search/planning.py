"""The quickest path from a start to a goal that does not touch the Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional

from mtr_core.se2 import Pose2
from mtr_core.states import Direction

from .. import problems
from ..geometry.fence import Fence
from ..geometry.keep_out import KeepOut
from ..geometry.route import moved
from ..parameters import MotionParameters
from ..timing.plan import Moving, Plan, PlanPart, PlanRefused
from .assembly import Assembly, line, pivot
from .candidates import MOVING_MPS, WayCandidates
from .goal_check import problem_at
from .options import StraightPiece, Target

# A robot this close to the goal's axis drives straight along it; the controller removes the offset as early as
# possible. With a given direction of travel the axis matters more than the time.
ON_AXIS_PER_M = 0.06
ON_AXIS_M = {Direction.ANY: 0.03, Direction.FORWARD: 0.12, Direction.BACKWARD: 0.12}
ON_AXIS_RAD = {Direction.ANY: math.radians(3.0), Direction.FORWARD: math.radians(10.0),
               Direction.BACKWARD: math.radians(10.0)}
# Within this distance a correction may drive in either direction, even if the goal specifies one.
CORRECTION_M = 0.10
MIN_CLEARANCE_M = 0.02
TURNING_RADPS = 0.05
# A path longer than the straight line by more than this is compared with a stop and a restart.
DETOUR_SHARE, DETOUR_M = 1.15, 0.3

# Possible excess of the estimated time of a candidate.
DOUBT_S = 0.3


class Effort(NamedTuple):
    """Effort of the search for the quickest path.

    Attributes:
        tried: maximum number of candidates that are planned in detail.
        compared: maximum number of collision-free candidates among them.
        blends: attempts to overlap turns with drives.
    """

    tried: int
    compared: int
    blends: int


STANDING = Effort(120, 8, 40)
# A moving robot follows its old plan until the new one is complete (replanning.py). This needs 0.09 s on average and at
# most 0.26 s (at rest: 0.1 and 0.5 s).
MOVING = Effort(6, 2, 3)


class Planning:
    """Plans in one frame, around one Car."""

    def __init__(self, keep_out: KeepOut, fence: Optional[Fence], parameters: MotionParameters, speed: float):
        self._keep_out, self._fence, self._parameters = keep_out, fence, parameters
        self._candidates = WayCandidates(keep_out, parameters, speed)
        self._assembly = Assembly(keep_out, fence, parameters, speed)

    def plan(self, start: Moving, goal: Target) -> Plan:
        """Return the quickest plan found that continues the present motion, with a stop first if necessary."""
        self._check(start.pose, goal.pose)
        effort = MOVING if moves(start) else STANDING
        self._assembly.blends_left = effort.blends
        turns_on_the_spot = moves(start) and abs(start.linear_mps) <= MOVING_MPS
        parts = None if turns_on_the_spot else self._parts(start, goal, effort)
        if moves(start) and self._may_gain_by_a_stop(parts, start.pose, goal.pose):
            brake = self._assembly.brake(start)
            # Without another path the robot will be at rest during the search for this one.
            stopped = self._parts(Moving(brake.trajectory.at(math.inf).pose), goal, effort if parts else STANDING)
            parts = quicker(parts, None if stopped is None else [brake, *stopped])
        if parts is None:
            raise PlanRefused(problems.NO_WAY_INSIDE() if self._fence else problems.NO_WAY())
        return Plan(goal.pose, tuple(parts))

    def straight(self, start: Moving, goal: Target) -> Optional[Plan]:
        """Return a plan without a turn, after a stop if necessary; it is made quickly. None without one."""
        self._check(start.pose, goal.pose)
        parts = self._straight(start, goal.pose, goal.direction)
        if parts is None and abs(start.linear_mps) > MOVING_MPS:
            brake = self._assembly.brake(start)
            rest = self._straight(Moving(brake.trajectory.at(math.inf).pose), goal.pose, goal.direction)
            parts = None if rest is None else [brake, *rest]
        return None if parts is None else Plan(goal.pose, tuple(parts))

    def _may_gain_by_a_stop(self, parts: Optional[List[PlanPart]], start: Pose2, goal: Pose2) -> bool:
        """Return False for a plan without a stop that is hardly longer than the straight line."""
        return parts is None or sum(part.trajectory.length_m for part in parts) > (
            DETOUR_SHARE * start.distance_to(goal) + DETOUR_M)

    def _check(self, start: Pose2, goal: Pose2) -> None:
        problem = problem_at(goal, self._keep_out)
        if problem:
            raise PlanRefused(problem)
        if self._keep_out.clearance(start) < MIN_CLEARANCE_M:
            raise PlanRefused(problems.ROBOT_TOO_CLOSE())
        if self._fence and not self._fence.holds_pose(goal):
            raise PlanRefused(problems.GOAL_OUTSIDE())
        if self._fence and not self._fence.holds_pose(start):
            raise PlanRefused(problems.ROBOT_OUTSIDE())

    def _parts(self, start: Moving, goal: Target, effort: Effort) -> Optional[List[PlanPart]]:
        parts = self._straight(start, goal.pose, goal.direction)
        return self._quickest(start, goal, effort) if parts is None else parts

    def _straight(self, start: Moving, goal: Pose2, direction: Direction) -> Optional[List[PlanPart]]:
        """Return the straight segment if the goal is on the robot's axis; no parts if the robot is at the goal."""
        arrival = self._parameters.arrival
        offset = goal.inverse() @ start.pose
        way = abs(offset.x)
        if way <= 0.5 * arrival.goal_along_m and abs(offset.y) <= 0.8 * arrival.goal_across_m:
            return None if moves(start) else self._assembly.timed(pivot(start.pose, goal.heading), start.pose)
        aside = max(arrival.goal_across_m, min(ON_AXIS_M[direction], ON_AXIS_PER_M * way))
        if abs(offset.heading) > ON_AXIS_RAD[direction] or abs(offset.y) > aside:
            return None
        sign = 1 if offset.x < 0.0 else -1
        wrong = Direction.BACKWARD if sign > 0 else Direction.FORWARD
        if direction == wrong and way > CORRECTION_M:
            return None
        if sign < 0 and direction == Direction.ANY and way > self._parameters.longest_reverse_m:
            return None
        drive = line(moved(goal, offset.x), StraightPiece(sign, way))
        return self._assembly.timed([(drive, sign * start.linear_mps)], start.pose)

    def _quickest(self, start: Moving, goal: Target, effort: Effort) -> Optional[List[PlanPart]]:
        best: Optional[List[PlanPart]] = None
        compared = 0
        for candidate in self._candidates.between(start, goal)[:effort.tried]:
            if compared == effort.compared or best is not None and candidate.time_s >= duration_of(best) + DOUBT_S:
                break
            best_s = math.inf if best is None else duration_of(best)
            parts = self._assembly.work_out(candidate, start, goal.pose, best_s)
            if parts is not None:
                compared += 1
                best = quicker(best, parts)
        return best


def duration_of(parts: List[PlanPart]) -> float:
    """Return the total time of the parts in s."""
    return sum(part.trajectory.duration_s for part in parts)


def quicker(first: Optional[List[PlanPart]], second: Optional[List[PlanPart]]) -> Optional[List[PlanPart]]:
    """Return the quicker one; None stands for a missing plan."""
    if first is None or second is None:
        return second if first is None else first
    return second if duration_of(second) < duration_of(first) else first


def moves(start: Moving) -> bool:
    """Return True if a plan from there must continue a motion."""
    return abs(start.linear_mps) > MOVING_MPS or abs(start.angular_radps) > TURNING_RADPS
