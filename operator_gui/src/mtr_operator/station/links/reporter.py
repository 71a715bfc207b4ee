"""Reports of a running test to the view, by the mailbox."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable, Sequence

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.ports import CarEvent, CarLink, LockState
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import RobotStatus

from ..bus.time_line import TimeLine
from ..events import ActionBegun, LineBegun, LineMeasured, LinesPlanned, RobotSilent, RobotSnapshot, known_facts
from ..mailbox import Mailbox
from .watched_link import WatchedRobotLink


class Reporter(RunObserver):
    """Observer of one test; calls after_status when a Status has been reported."""

    def __init__(self, mailbox: Mailbox, robot: WatchedRobotLink, car: CarLink, progress: Progress,
                 after_status: Callable[[], None], *, time_line: TimeLine):
        self._mailbox = mailbox
        self._robot = robot
        self._car = car
        self._progress = progress
        self._after_status, self._time_line = after_status, time_line

    def on_status(self, status: RobotStatus) -> None:
        bus = part(self._car, BusMonitor)
        self._mailbox.put_robot(RobotSnapshot(status, self._car.lock_state, self._car.problem, self._robot.waypoint,
                                              self._robot.is_secret, bus.traffic, known_facts(self._car),
                                              self._robot.is_exposed, signals=tuple(bus.signals)))
        self._after_status()

    def on_car(self, status: RobotStatus, events: Sequence[CarEvent], lock_state: LockState) -> None:
        self._time_line.learn(status, events, lock_state)

    def on_plan(self, done: int, total: int) -> None:
        self._mailbox.put(LinesPlanned(done, total, self._progress.car))

    def on_action(self, text: str) -> None:
        self._mailbox.put(ActionBegun(text))

    def on_line(self, number: int) -> None:
        self._mailbox.put(LineBegun(number))

    def on_result(self, result: LineResult, done: int, total: int) -> None:
        self._mailbox.put(LineMeasured(tuple(self._progress.results), result, done, total))

    def on_link_silent(self, silent_s: float) -> None:
        self._mailbox.put(RobotSilent(silent_s))
