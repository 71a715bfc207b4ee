"""What a view learns while a test runs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ..ports import CarEvent, LockState
from ..results.line_result import LineResult
from ..robot_status import RobotStatus


class RunObserver:
    """Receives everything in the runner's thread, shows nothing; a view overrides what it shows."""

    def on_status(self, status: RobotStatus) -> None:
        """A Status arrived."""

    def on_car(self, status: RobotStatus, events: Sequence[CarEvent], lock_state: LockState) -> None:
        """The Car was observed up to this Status: changes of its locks, and their state."""

    def on_plan(self, done: int, total: int) -> None:
        """The lines are known: so many of them are measured already."""

    def on_action(self, text: str) -> None:
        """The robot begins to do this."""

    def on_line(self, number: int) -> None:
        """The line with this number is measured from now on; 0: none is."""

    def on_result(self, result: LineResult, done: int, total: int) -> None:
        """A line was measured, or measured again."""

    def on_link_silent(self, silent_s: float) -> None:
        """Nothing has come from the robot for so long in wall time."""
