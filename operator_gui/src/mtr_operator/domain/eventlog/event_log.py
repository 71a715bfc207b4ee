"""Event log: all events of robot, Car and test, in the order of their reports."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import datetime
from typing import Callable, Iterator, Sequence

from ..ports import CarEvent
from ..results.session_record import now
from ..robot_status import RobotStatus
from .entry import APPLICATION, CAR, ERROR, INFO, WARNING, EventEntry, EventKind
from .robot_events import RobotEvents, is_alike, over

Listener = Callable[[EventEntry], None]
_CAUSES = {"passive_entry": "the key's vicinity", "key_button": "the key's button", "handle": "the handle"}


class EventLog:
    """Dispatcher that passes each entry to its listeners without storing it; belongs to the thread that takes the
    Statuses."""

    def __init__(self, clock: Callable[[], datetime.datetime] = now):
        self._clock = clock
        self._listeners: list[Listener] = []
        self._robot = RobotEvents()
        self._problem = ""
        self._heard: datetime.datetime | None = None
        self._is_silent = False

    @contextlib.contextmanager
    def told_to(self, listener: Listener) -> Iterator[None]:
        """Context in which a listener is called for each entry."""
        self.listen(listener)
        try:
            yield
        finally:
            self._listeners.remove(listener)

    def listen(self, listener: Listener) -> None:
        """Call a listener for each entry from now on."""
        self._listeners.append(listener)

    def learn(self, status: RobotStatus, events: Sequence[CarEvent] = (), problem: str = "") -> None:
        """Add a Status, its lock changes, and the fault of the Car's bus."""
        time = self._clock()
        self._end_silence(time, status)
        for entry in self._robot.learn(status, time):
            self._tell(entry)
        for event in events:
            self._tell_locks(time, event)
        self._learn_problem(time, status, problem)
        self._heard = time

    def silent(self) -> None:
        """Report that the robot is silent; repeated calls are ignored."""
        if not self._is_silent:
            self._is_silent = True
            self.add(EventKind.FAULT, "The robot is not heard any more.", ERROR)

    def add(self, kind: EventKind, text: str, severity: int = INFO, time: datetime.datetime | None = None) -> None:
        """Add an event of the application; time: of the event, None for now."""
        self._tell(EventEntry(time or self._clock(), None, kind, severity, APPLICATION, text))

    def _tell(self, entry: EventEntry) -> None:
        for listener in self._listeners:
            listener(entry)

    def _end_silence(self, time: datetime.datetime, status: RobotStatus) -> None:
        if self._is_silent:
            self._is_silent = False
            silent_s = (time - (self._heard or time)).total_seconds()
            self._tell(EventEntry(time, status.stamp_s, EventKind.FAULT, INFO, APPLICATION,
                                  f"The robot is heard again after {silent_s:.1f} s."))

    def _tell_locks(self, time: datetime.datetime, event: CarEvent) -> None:
        cause = f" ({_CAUSES.get(event.source, event.source)})" if event.source else ""
        self._tell(EventEntry(time, event.time_s, EventKind.LOCKS, INFO, CAR,
                              f"The Car is {event.lock_state.value} now{cause}."))
        if event.doubt:
            self._tell(EventEntry(time, event.time_s, EventKind.LOCKS, WARNING, CAR, event.doubt))

    def _learn_problem(self, time: datetime.datetime, status: RobotStatus, problem: str) -> None:
        if problem and not is_alike(problem, self._problem):
            self._tell(EventEntry(time, status.stamp_s, EventKind.FAULT, ERROR, CAR, problem))
        elif self._problem and not problem:
            self._tell(EventEntry(time, status.stamp_s, EventKind.FAULT, INFO, CAR, over(self._problem)))
        self._problem = problem
