"""Calls of the device's services: one at a time, each with an end.

The protocol has no number that ties an answer to its call. So after a call that was not answered in time no other is
made until the late answer has come or can come no more; else it would be taken for the next call's.
"""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Optional

# An answer that has not come within so many time-outs will not come any more.
OVERDUE_TIMEOUTS = 2.0


class CallState(enum.Enum):
    """How a service's newest call stands."""

    IDLE = 0
    WAITING = 1
    ANSWERED = 2
    OVERDUE = 3


class Calls:
    """The calls of one service.

    Attributes:
        answer: payload of the newest answered call.
        late: answers that came after their call had failed.
    """

    def __init__(self, timeout_s: float):
        self._timeout_s = timeout_s
        self._state = CallState.IDLE
        self._until_s = 0.0
        self.answer: Optional[bytes] = None
        self.late = 0

    def begin(self, now_s: float) -> str:
        """Start a call; returns why that is not possible now, or nothing."""
        state = self.state(now_s)
        if state is CallState.WAITING:
            return "another call is under way"
        if state is CallState.OVERDUE:
            return "the call before has not been answered; try again in some seconds"
        self._state, self._until_s, self.answer = CallState.WAITING, now_s + self._timeout_s, None
        return ""

    def take(self, answer: bytes, now_s: float) -> None:
        """Take an answer of the device."""
        if self.state(now_s) is CallState.WAITING:
            self._state, self.answer = CallState.ANSWERED, answer
        else:
            self.late += 1
            if self._state is CallState.OVERDUE:
                self._state = CallState.IDLE

    def abort(self) -> None:
        """The link is gone, and the answer with it."""
        self._state = CallState.IDLE

    def state(self, now_s: float) -> CallState:
        """How the newest call stands."""
        if self._state is CallState.WAITING and now_s >= self._until_s:
            self._state, self._until_s = CallState.OVERDUE, self._until_s + OVERDUE_TIMEOUTS * self._timeout_s
        if self._state is CallState.OVERDUE and now_s >= self._until_s:
            self._state = CallState.IDLE
        return self._state
