"""Goals for the motion planner, and what came of the Operator's waypoint."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Hashable, Optional

from mtr_core.problems import NO_PROBLEM
from mtr_core.states import Result

from .observation import Motion, Place

NO_GOAL = Place()


class Goals:
    """Gives each order to move a goal id of its own, whatever session or mapping it comes from.

    Attributes:
        goal: the present goal, id 0 for none.
    """

    def __init__(self) -> None:
        self.goal = NO_GOAL
        self._count = 0
        self._key: Optional[Hashable] = None

    def pursue(self, key: Hashable, place: Place) -> None:
        """Make place the goal; a key that differs from the one pursued before is a new goal."""
        if key != self._key:
            self._count += 1
            self._key, self.goal = key, replace(place, id=self._count)

    def pause(self) -> None:
        """Stand still; what is pursued next is a new goal, even at the same place."""
        self._key, self.goal = None, NO_GOAL


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

    def update(self, goal: Place, motion: Motion) -> None:
        """Take the planner's report on the goal that stands for the waypoint."""
        if self.result in (Result.IDLE, Result.REACHED):
            return
        if goal.id and motion.goal_id == goal.id and motion.result is not Result.IDLE:
            self.result, self.message = motion.result, motion.message
        else:
            self.result, self.message = Result.PENDING, NO_PROBLEM
