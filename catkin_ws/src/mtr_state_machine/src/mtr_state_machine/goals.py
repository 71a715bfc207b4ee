"""Goals for the motion planner, and what became of the Operator's waypoint."""
# SPDX-License-Identifier: Apache-2.0
from typing import Hashable, Optional

from mtr_core.problems import NO_PROBLEM
from mtr_core.requests import NO_GOAL, Goal, GoalReport, Waypoint
from mtr_core.states import Result

MICROSECONDS_PER_S = 1e6


class Goals:
    """Makes goals of waypoints: each time that one is taken up it is a new goal.

    Attributes:
        goal: the present goal, NO_GOAL to stand still.
    """

    def __init__(self) -> None:
        self.goal = NO_GOAL
        self._attempts = 0
        self._wanted: Optional[Hashable] = None

    def pursue(self, waypoint: Waypoint, purpose: Hashable, now_s: float) -> None:
        """Make the waypoint the goal; the same one for another purpose is taken up anew.

        now_s, of the steady clock, makes an attempt that none of before had, not even before a restart of this node:
        the motion planner may remember it.
        """
        wanted = (waypoint.requester, waypoint.id, purpose)
        if wanted != self._wanted:
            self._attempts = max(self._attempts + 1, round(now_s * MICROSECONDS_PER_S))
            self._wanted, self.goal = wanted, Goal(waypoint, self._attempts)

    def is_new(self, waypoint: Waypoint, purpose: Hashable) -> bool:
        """True for a waypoint that is not the goal yet, or is for another purpose."""
        return (waypoint.requester, waypoint.id, purpose) != self._wanted

    def pause(self) -> None:
        """Stand still; what is pursued next is a new goal, even at the same waypoint."""
        self._wanted, self.goal = None, NO_GOAL


class WaypointResult:
    """Result of the Operator's newest waypoint.

    Attributes:
        session_id: session that the waypoint belongs to.
        waypoint_id: 0 before the first.
        result: REACHED stays until the next waypoint.
        message: the planner's sentence.
    """

    def __init__(self) -> None:
        self.session_id = 0
        self.waypoint_id = 0
        self.result = Result.IDLE
        self.message = NO_PROBLEM

    def expect(self, session_id: int, waypoint_id: int) -> None:
        """The Operator wants this waypoint now; 0 is none."""
        if (session_id, waypoint_id) != (self.session_id, self.waypoint_id):
            self.session_id, self.waypoint_id, self.message = session_id, waypoint_id, NO_PROBLEM
            self.result = Result.PENDING if waypoint_id else Result.IDLE

    def reopen(self) -> None:
        """The robot has left the waypoint for something else; it is to be reached again."""
        if self.waypoint_id:
            self.result, self.message = Result.PENDING, NO_PROBLEM

    def update(self, goal: Goal, motion: GoalReport) -> None:
        """Take the planner's report on the goal that stands for the waypoint."""
        if self.result in (Result.IDLE, Result.REACHED):
            return
        if motion.is_about(goal) and motion.result is not Result.IDLE:
            self.result, self.message = motion.result, motion.message
        else:
            self.result, self.message = Result.PENDING, NO_PROBLEM
