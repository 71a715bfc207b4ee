"""Calls of the device's services: one at a time, each with a time limit.

The protocol has no number that links an answer to its call. After an unanswered call, further calls are therefore
rejected until the late answer has arrived or is no longer expected. Otherwise it would be mistaken for the answer to
the next call.
"""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Optional

# Number of time-outs after which a late answer is no longer expected.
OVERDUE_TIMEOUTS = 2.0


class CallState(enum.Enum):
    """State of a service's newest call."""

    IDLE = 0
    WAITING = 1
    ANSWERED = 2
    OVERDUE = 3


class Calls:
    """Calls of one service.

    Attributes:
        answer: payload of the newest answered call.
        late: number of answers that arrived after their call had failed.
    """

    def __init__(self, timeout_s: float):
        self._timeout_s = timeout_s
        self._state = CallState.IDLE
        self._until_s = 0.0
        self.answer: Optional[bytes] = None
        self.late = 0

    def begin(self, now_s: float) -> str:
        """Start a call; return the reason if that is not possible at present, otherwise an empty text."""
        state = self.state(now_s)
        if state is CallState.WAITING:
            return "another call is under way"
        if state is CallState.OVERDUE:
            return "the call before has not been answered; try again in some seconds"
        self._state, self._until_s, self.answer = CallState.WAITING, now_s + self._timeout_s, None
        return ""

    def take(self, answer: bytes, now_s: float) -> None:
        """Accept an answer of the device."""
        if self.state(now_s) is CallState.WAITING:
            self._state, self.answer = CallState.ANSWERED, answer
        else:
            self.late += 1
            if self._state is CallState.OVERDUE:
                self._state = CallState.IDLE

    def abort(self) -> None:
        """Abort the call, because the link and its answer are lost."""
        self._state = CallState.IDLE

    def state(self, now_s: float) -> CallState:
        """Return the state of the newest call."""
        if self._state is CallState.WAITING and now_s >= self._until_s:
            self._state, self._until_s = CallState.OVERDUE, self._until_s + OVERDUE_TIMEOUTS * self._timeout_s
        if self._state is CallState.OVERDUE and now_s >= self._until_s:
            self._state = CallState.IDLE
        return self._state
