"""Makes plans while the robot drives: each starts where the present motion will be when the plan is due.

On the robot's own clock a plan is made in a separate process and may be late. In simulation it is made within the
requesting tick, however long that takes, so that the result does not depend on the machine's speed.
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

# Time after a new goal at which a moving robot switches to the new plan; planning needs less time (planning.py).
LEAD_S = 0.4
ROUNDING_S, ROUNDING_MPS = 0.001, 0.005
# If the reference is farther from the plan's start when the plan is due, it has waited for the robot meanwhile.
START_M, START_RAD = 0.03, math.radians(3.0)

@dataclass(frozen=True)
class PendingPlan:
    """A plan in preparation, and the time from which it may be followed."""

    plan: "Future[Plan]"
    start: Moving
    due_s: float

    def is_due(self, tick_s: float) -> bool:
        """Return True if the plan is to be followed from this tick on."""
        return tick_s > self.due_s - ROUNDING_S

    def fits(self, follower: Optional[Follower]) -> bool:
        """Return True if the robot is at the plan's start: it has rested there, or its reference has arrived there."""
        if not moves(self.start):
            return True
        if follower is None:
            return False
        off = deviation(follower.reference(), self.start.pose)
        return math.hypot(off.x, off.y) < START_M and abs(off.heading) < START_RAD


class Replanning:
    """The plan that is followed, and the newest plan in preparation.

    Attributes:
        follower: of the present plan, or None.
        is_needed: True if another plan must be made.
        is_uncovering: True while the robot drives straight ahead to see the ground behind it, before a plan with a
            turn.
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
        """True while a plan is in preparation or not yet due."""
        return self._pending is not None

    def restart(self) -> None:
        """Request another plan; the present one is followed until the new plan continues its motion."""
        if self._pending is not None:
            # A plan that has not been started is cancelled; otherwise quickly changing goals would pile up work.
            self._pending.plan.cancel()
        self._pending, self.is_needed = None, True

    def stop(self) -> None:
        """Stop following; the next plan starts where the robot comes to rest."""
        self.restart()
        self.follower = None

    def take_path(self) -> Optional[Path]:
        """Return the line of a plan that is followed since the last call."""
        path, self._new_path = self._new_path, None
        return path

    def plan(self, site: Site, target: Target, robot: Moving, tick_s: float, speed: float, *,
             uncovers: bool = False) -> None:
        """Follow a plan that is made quickly, or start to make another; without a reference the robot stops first.

        uncovers: a robot at rest that has to turn drives straight ahead first. Raises PlanRefused without a plan.
        """
        planning = Planning(site.keep_out, site.fence, self._parameters, speed)
        # In another frame the coordinates of the previous plan are invalid.
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
            # A robot that exceeds, or will exceed, the new speed limit changes its plan at once.
            fastest = max(abs(present.linear_mps), abs(self.follower.moving(LEAD_S).linear_mps))
            lead_s = LEAD_S if fastest <= speed + ROUNDING_MPS else 0.0
            self._begin(planning, target, self.follower.moving(lead_s), tick_s + lead_s)
        self.is_needed = plan is None and self._pending is None

    def change_over(self, site: Site, tick_s: float, speed: float) -> None:
        """Follow the plan that is due; if it is late, the robot stops. Raises PlanRefused without a plan."""
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
    """Return True for a plan without a drive: a turn on the spot."""
    return abs((start.pose.inverse() @ plan.goal).x) < START_M


def _ahead_of(start: Moving, planning: Planning) -> Optional[Plan]:
    """Return a plan straight ahead, or None if that path is not free."""
    try:
        return planning.straight(start, Target(moved(start.pose, AHEAD_M), Direction.FORWARD))
    except PlanRefused:
        return None
