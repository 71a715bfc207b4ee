"""Events from Statuses: the robot's log, its notifications, and changes between two Statuses."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import re
from typing import Iterator

from ..robot_status import Notification, RobotStatus
from .changes import changes
from .entry import ERROR, INFO, ROBOT, WARNING, EventEntry, EventKind

# Code of the link itself, in a single Status.
_RESTARTED_CODE = "robot_restarted"
# Time in which the robot registers that a session of this application has followed another one.
_OTHER_FOR_S = 1.0
_FIGURES = re.compile(r"\d+")


class RobotEvents:
    """Events of consecutive Statuses. A sentence of the log is in several Statuses, and is reported once."""

    def __init__(self) -> None:
        self._before: RobotStatus | None = None
        self._newest_log_id = 0
        self._notices: dict[str, Notification] = {}
        self._other_since_s: float | None = None
        self._is_other_told = False

    def learn(self, status: RobotStatus, time: datetime.datetime) -> Iterator[EventEntry]:
        """Yield the new events of a Status; time: of its arrival."""
        before = self._before
        if before is not None and status.robot_session_id != before.robot_session_id:
            self._newest_log_id = 0
            before = None
            yield EventEntry(time, status.stamp_s, EventKind.FAULT, WARNING, ROBOT, "The robot has started anew.")
        if status.log:
            yield from self._log(status, time)
        if status.notifications or self._notices:
            yield from self._notified(status, time)
        for said in changes(before, status) if before is not None else ():
            yield EventEntry(time, status.stamp_s, said.kind, said.severity, ROBOT, said.text)
        yield from self._control(status, time)
        self._before = status

    def _log(self, status: RobotStatus, time: datetime.datetime) -> Iterator[EventEntry]:
        for message in sorted(status.log, key=lambda message: message.id):
            if message.id > self._newest_log_id:
                self._newest_log_id = message.id
                severity = min(max(message.severity, INFO), ERROR)
                yield EventEntry(time, message.stamp_s, EventKind.ROBOT_LOG, severity, message.source or ROBOT,
                                 " ".join(message.text.split()))

    def _notified(self, status: RobotStatus, time: datetime.datetime) -> Iterator[EventEntry]:
        now = {each.code or each.text: each for each in status.notifications if each.code != _RESTARTED_CODE}
        for code, notice in now.items():
            former = self._notices.get(code)
            if former is None or not is_alike(former.text, notice.text):
                yield EventEntry(time, status.stamp_s, EventKind.FAULT, notice.severity, ROBOT, notice.text)
        for code, notice in self._notices.items():
            if code not in now:
                yield EventEntry(time, status.stamp_s, EventKind.FAULT, INFO, ROBOT, over(notice.text))
        self._notices = now

    def _control(self, status: RobotStatus, time: datetime.datetime) -> Iterator[EventEntry]:
        if not status.controlled_by_other:
            if self._is_other_told:
                yield EventEntry(time, status.stamp_s, EventKind.FAULT, INFO, ROBOT,
                                 "No other application controls the robot any more.")
            self._other_since_s, self._is_other_told = None, False
            return
        if self._other_since_s is None:
            self._other_since_s = status.stamp_s
        if not self._is_other_told and status.stamp_s - self._other_since_s >= _OTHER_FOR_S:
            self._is_other_told = True
            yield EventEntry(time, status.stamp_s, EventKind.FAULT, WARNING, ROBOT,
                             "Another application controls the robot.")


def is_alike(one: str, other: str) -> bool:
    """Return True if two sentences differ only in their figures: a changed distance is not a new event."""
    return _FIGURES.sub("", one) == _FIGURES.sub("", other)


def over(text: str) -> str:
    """Return the sentence for the end of a condition."""
    return f"Over: {text}"
