"""What a test does, for the event list."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from typing import Iterator, Sequence

from ..errors import OperatorError
from ..eventlog.entry import ERROR, INFO, WARNING, EventKind
from ..eventlog.event_log import EventLog
from ..ports import CarEvent, LockState
from ..results.line_result import LineResult
from ..robot_status import RobotStatus
from .observer import RunObserver
from .trouble import Cancelled


class EventObserver(RunObserver):
    """Notes actions, results and silence in the event list, and hands everything on.

    line_word: what the scenario calls a line.
    """

    def __init__(self, observer: RunObserver, events: EventLog, line_word: str):
        self._observer = observer
        self._events = events
        self._line_word = line_word
        self._action = ""

    def on_status(self, status: RobotStatus) -> None:
        self._observer.on_status(status)

    def on_car(self, status: RobotStatus, events: Sequence[CarEvent], lock_state: LockState) -> None:
        self._observer.on_car(status, events, lock_state)

    def on_plan(self, done: int, total: int) -> None:
        self._observer.on_plan(done, total)

    def on_action(self, text: str) -> None:
        if text != self._action:
            self._action = text
            self._events.add(EventKind.TEST, text)
        self._observer.on_action(text)

    def on_line(self, number: int) -> None:
        self._observer.on_line(number)

    def on_result(self, result: LineResult, done: int, total: int) -> None:
        said = result.reason or "measured"
        self._events.add(EventKind.TEST, f"{self._line_word} {result.number} ({result.place}): {said}",
                         WARNING if result.reason else INFO)
        self._observer.on_result(result, done, total)

    def on_link_silent(self, silent_s: float) -> None:
        self._events.silent()
        self._observer.on_link_silent(silent_s)


@contextlib.contextmanager
def run_told(events: EventLog, is_continued: bool) -> Iterator[None]:
    """Context of one run of a test; its beginning and its end are in the event list."""
    events.add(EventKind.TEST, "The test goes on." if is_continued else "The test begins.")
    try:
        yield
    except Cancelled:
        events.add(EventKind.TEST, "The test is paused.", WARNING)
        raise
    except OperatorError as error:
        events.add(EventKind.FAULT, str(error), ERROR)
        raise
    events.add(EventKind.TEST, "All lines are measured.")
