"""Goals for the motion planner, and the result of the Operator's waypoint."""
# SPDX-License-Identifier: Apache-2.0
from typing import Hashable, Optional

from mtr_core.problems import NO_PROBLEM
from mtr_core.requests import NO_GOAL, Goal, GoalReport, Waypoint
from mtr_core.states import Result

MICROSECONDS_PER_S = 1e6


class Goals:
    """Converts waypoints to goals; a resumed waypoint is a new goal.

    Attributes:
        goal: the present goal, NO_GOAL to stop.
    """

    def __init__(self) -> None:
        self.goal = NO_GOAL
        self._attempts = 0
        self._wanted: Optional[Hashable] = None

    def pursue(self, waypoint: Waypoint, purpose: Hashable, now_s: float) -> None:
        """Make the waypoint the goal; the same waypoint for another purpose is a new goal.

        now_s of the steady clock yields an attempt number that was never used, not even before a restart of this node,
        because the motion planner may remember it.
        """
        wanted = (waypoint.requester, waypoint.id, purpose)
        if wanted != self._wanted:
            self._attempts = max(self._attempts + 1, round(now_s * MICROSECONDS_PER_S))
            self._wanted, self.goal = wanted, Goal(waypoint, self._attempts)

    def is_new(self, waypoint: Waypoint, purpose: Hashable) -> bool:
        """Return True for a waypoint that is not the goal yet, or has another purpose."""
        return (waypoint.requester, waypoint.id, purpose) != self._wanted

    def pause(self) -> None:
        """Stop; the next waypoint is a new goal, even if it is the same one."""
        self._wanted, self.goal = None, NO_GOAL


class WaypointResult:
    """Result of the Operator's newest waypoint.

    Attributes:
        session_id: session that the waypoint belongs to.
        waypoint_id: 0 before the first.
        result: REACHED remains until the next waypoint.
        message: the planner's sentence.
    """

    def __init__(self) -> None:
        self.session_id = 0
        self.waypoint_id = 0
        self.result = Result.IDLE
        self.message = NO_PROBLEM

    def expect(self, session_id: int, waypoint_id: int) -> None:
        """Set the waypoint that the Operator wants; 0 is none."""
        if (session_id, waypoint_id) != (self.session_id, self.waypoint_id):
            self.session_id, self.waypoint_id, self.message = session_id, waypoint_id, NO_PROBLEM
            self.result = Result.PENDING if waypoint_id else Result.IDLE

    def reopen(self) -> None:
        """Reset the result, because the robot has left the waypoint and has to reach it again."""
        if self.waypoint_id:
            self.result, self.message = Result.PENDING, NO_PROBLEM

    def update(self, goal: Goal, motion: GoalReport) -> None:
        """Process the planner's report on the goal of the waypoint."""
        if self.result in (Result.IDLE, Result.REACHED):
            return
        if motion.is_about(goal) and motion.result is not Result.IDLE:
            self.result, self.message = motion.result, motion.message
        else:
            self.result, self.message = Result.PENDING, NO_PROBLEM
