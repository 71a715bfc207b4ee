"""Waiting of simulated time for the Operator's application, and the messages that belong to a tick."""
# SPDX-License-Identifier: Apache-2.0
import collections
import time
from typing import Callable, Deque, Generic, Iterator, Sequence, TypeVar

from .session import ControlSession

Message = TypeVar("Message")


class OperatorWait:
    """Wait for the application: at each tick call begin, then is_over until it returns True.

    Attributes:
        operator_gone: an application in control did not answer in time; ticks do not wait before its next Command.
    """

    def __init__(self, lost_after_wall_s: float, wall_clock: Callable[[], float] = time.monotonic):
        self._lost_after_wall_s, self._wall_clock = lost_after_wall_s, wall_clock
        self._patient_until = 0.0
        self.operator_gone = False

    def begin(self) -> None:
        """Start to wait for the answer to a published Status."""
        self._patient_until = self._wall_clock() + self._lost_after_wall_s

    def received(self) -> None:
        """Note a Command of the application in control."""
        self.operator_gone = False
        self.begin()

    def is_over(self, session: ControlSession, status_id: int) -> bool:
        """Return True if the tick may continue: the Status is answered, or the application in control is gone.

        Without an application in control, simulated time stops until one connects.
        """
        if session.answered_status_id >= status_id:
            return True
        if session.session_id and self._wall_clock() >= self._patient_until:
            self.operator_gone = True
        return bool(session.session_id) and self.operator_gone


class Unread(Generic[Message]):
    """Received messages of the link that are not processed yet.

    In lock-step a message after the answer to the newest Status belongs to the next tick. An application that receives
    nothing for one second sends a stop, although this process or another one was only suspended. If such a stop were
    processed together with the answer, the load of the machine would stop the robot.

    receive: returns the arrived messages, and waits up to the given number of seconds.
    """

    def __init__(self, receive: Callable[[float], Sequence[Message]]):
        self._receive = receive
        self._messages: Deque[Message] = collections.deque()

    def come(self, timeout_s: float) -> bool:
        """Return True if a message is available; wait only if none is left from the previous call."""
        if not self._messages:
            self._messages.extend(self._receive(timeout_s))
        return bool(self._messages)

    def until(self, is_enough: Callable[[], bool]) -> Iterator[Message]:
        """Yield the messages in order, until is_enough returns True."""
        while self._messages and not is_enough():
            yield self._messages.popleft()
