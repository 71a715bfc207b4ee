"""Makes plans while the robot goes on: each begins where the present motion will be when the plan is due.

On the robot's own clock a plan is made in a process of its own and may be late; in simulation it is made within the
tick that asks for it, however long that takes, so that the result does not depend on the machine's speed.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Optional

from mtr_core.states import Direction

from .following.follower import Follower
from .following.ground_behind import AHEAD_M
from .following.tracking import deviation
from .geometry.route import moved
from .outputs import Path
from .parameters import MotionParameters
from .search.options import Target
from .search.planning import Planning, moves
from .site import Site
from .timing.plan import Moving, Plan, PlanRefused

# So long after a new goal a moving robot goes on with the new plan, which takes less time to make (planning.py).
LEAD_S = 0.4
ROUNDING_S, ROUNDING_MPS = 0.001, 0.005
# A reference that is farther from the plan's start when the plan is due has waited for the robot meanwhile.
START_M, START_RAD = 0.03, math.radians(3.0)

@dataclass(frozen=True)
class PendingPlan:
    """A plan that is being made, and from when on it may be followed."""

    plan: "Future[Plan]"
    start: Moving
    due_s: float

    def is_due(self, tick_s: float) -> bool:
        """True when it is to be followed from this tick on."""
        return tick_s > self.due_s - ROUNDING_S

    def fits(self, follower: Optional[Follower]) -> bool:
        """True when the robot is where the plan begins: it stands there still, or its reference has come there."""
        if not moves(self.start):
            return True
        if follower is None:
            return False
        off = deviation(follower.reference(), self.start.pose)
        return math.hypot(off.x, off.y) < START_M and abs(off.heading) < START_RAD


class Replanning:
    """The plan that is followed, and the newest one that is being made to take its place.

    Attributes:
        follower: at work, None when there is nothing to follow.
        is_needed: True when another plan is to be made.
        is_uncovering: True while the robot drives straight ahead to see the ground behind it, before a plan that turns.
    """

    def __init__(self, parameters: MotionParameters, executor: Executor):
        """executor: makes the plans."""
        self._parameters, self._executor = parameters, executor
        self._pending: Optional[PendingPlan] = None
        self._in_car_frame = False
        self._new_path: Optional[Path] = None
        self.follower: Optional[Follower] = None
        self.is_needed = True
        self.is_uncovering = False

    @property
    def is_under_way(self) -> bool:
        """True while a plan is being made, or waits until it is due."""
        return self._pending is not None

    def restart(self) -> None:
        """Have another plan made; the present one is followed until that goes on from its motion."""
        if self._pending is not None:
            # One that has not been begun shall not be: goals that change quickly would pile up work.
            self._pending.plan.cancel()
        self._pending, self.is_needed = None, True

    def stop(self) -> None:
        """Follow nothing; another plan begins where the robot comes to stand."""
        self.restart()
        self.follower = None

    def take_path(self) -> Optional[Path]:
        """The line of a plan that is followed since the last call."""
        path, self._new_path = self._new_path, None
        return path

    def plan(self, site: Site, target: Target, robot: Moving, tick_s: float, speed: float, *,
             uncovers: bool = False) -> None:
        """Follow a plan that is quickly made, or begin to make another; without a reference the robot stops first.

        uncovers: a robot at rest that has to turn drives straight ahead first. PlanRefused when there is no plan.
        """
        planning = Planning(site.keep_out, site.fence, self._parameters, speed)
        # Another frame has other coordinates: what was followed means nothing in it.
        if self._in_car_frame != site.in_car_frame or not (self.follower and self.follower.is_near(robot.pose)):
            self.follower = None
        present = self.follower.moving() if self.follower else robot
        plan = planning.straight(present, target)
        self.is_uncovering = False
        if uncovers and not moves(present) and (plan is None or _turns_first(present, plan)):
            ahead = _ahead_of(present, planning)
            self.is_uncovering, plan = ahead is not None, ahead or plan
        if plan:
            self._follow(plan, site, speed)
        elif not moves(present):
            self._begin(planning, target, present, tick_s)
        elif self.follower:
            # A robot that is, or gets, faster than it now may be does not go on so.
            fastest = max(abs(present.linear_mps), abs(self.follower.moving(LEAD_S).linear_mps))
            lead_s = LEAD_S if fastest <= speed + ROUNDING_MPS else 0.0
            self._begin(planning, target, self.follower.moving(lead_s), tick_s + lead_s)
        self.is_needed = plan is None and self._pending is None

    def change_over(self, site: Site, tick_s: float, speed: float) -> None:
        """Follow the plan that is due; a robot whose plan is late stops. PlanRefused when there is none."""
        pending = self._pending
        if pending is None or not pending.is_due(tick_s):
            return
        if not pending.plan.done():
            self.follower = None
        elif not pending.fits(self.follower):
            self.restart()
        else:
            self._pending = None
            self._follow(pending.plan.result(), site, speed)

    def _begin(self, planning: Planning, target: Target, start: Moving, due_s: float) -> None:
        self._pending = PendingPlan(self._executor.submit(planning.plan, start, target), start, due_s)

    def _follow(self, plan: Plan, site: Site, speed: float) -> None:
        self._in_car_frame = site.in_car_frame
        self.follower = Follower(plan, self._parameters, speed)
        self._new_path = Path(site.in_car_frame, tuple(plan.points))


def _turns_first(start: Moving, plan: Plan) -> bool:
    """True for a plan without a drive: a turn on the spot."""
    return abs((start.pose.inverse() @ plan.goal).x) < START_M


def _ahead_of(start: Moving, planning: Planning) -> Optional[Plan]:
    """None where the way straight ahead is not free."""
    try:
        return planning.straight(start, Target(moved(start.pose, AHEAD_M), Direction.FORWARD))
    except PlanRefused:
        return None
