"""Makes plans while the robot goes on: each begins where the present motion will be when the plan is due.

On the robot's own clock a plan is made in a thread and may be late; in simulation it is made within the tick that asks
for it, however long that takes, so that the result does not depend on the machine's speed.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any, Callable, Optional

from .following.follower import Follower
from .following.tracking import deviation
from .search.options import Goal
from .search.planning import Planning, moves
from .timing.plan import Moving, Plan

# From the order to a moving robot until it goes on with the new plan, which takes less time to make (planning.py).
LEAD_S = 0.4
ROUNDING_S = 0.001
# A reference that is farther from the plan's start when the plan is due has waited for the robot meanwhile.
START_M, START_RAD = 0.03, math.radians(3.0)


class InlineExecutor(Executor):
    """Does its work before it returns."""

    def submit(self, work: Callable[..., Any], *arguments: Any, **named: Any) -> "Future[Any]":
        """The work's result."""
        done: Future = Future()
        try:
            done.set_result(work(*arguments, **named))
        except Exception as error:
            done.set_exception(error)
        return done


@dataclass(frozen=True)
class PendingPlan:
    """A plan that is being made, and from when on it may be followed."""

    plan: "Future[Plan]"
    start: Moving
    due_s: float


class BackgroundPlanning:
    """Makes the newest plan that was asked for; older ones are forgotten."""

    def __init__(self, executor: Executor):
        self._executor = executor
        self._pending: Optional[PendingPlan] = None

    @property
    def is_at_work(self) -> bool:
        """True from the order until the plan was taken or forgotten."""
        return self._pending is not None

    def forget(self) -> None:
        """The plan is no longer wanted."""
        self._pending = None

    def begin(self, planning: Planning, goal: Goal, start: Moving, due_s: float) -> None:
        """Make a plan from the start, where the robot is when it is due."""
        self._pending = PendingPlan(self._executor.submit(planning.plan, start, goal), start, due_s)

    def is_due(self, tick_s: float) -> bool:
        """True when the plan is to be followed from this tick on."""
        return tick_s > self._pending.due_s - ROUNDING_S

    def is_done(self) -> bool:
        """True when there is a result."""
        return self._pending.plan.done()

    def fits(self, follower: Optional[Follower]) -> bool:
        """True when the robot is where the plan begins: it stands there still, or its reference has come there."""
        if not moves(self._pending.start):
            return True
        if follower is None:
            return False
        off = deviation(follower.reference(), self._pending.start.pose)
        return math.hypot(off.x, off.y) < START_M and abs(off.heading) < START_RAD

    def take(self) -> Plan:
        """The plan; PlanRefused when there is none."""
        pending, self._pending = self._pending, None
        return pending.plan.result()
