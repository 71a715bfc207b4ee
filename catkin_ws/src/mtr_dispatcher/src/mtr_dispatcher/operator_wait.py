"""How long simulated time waits for the Operator's application, and what it takes of it at a tick."""
# SPDX-License-Identifier: Apache-2.0
import collections
import time
from typing import Callable, Deque, Generic, Iterator, Sequence, TypeVar

from .session import ControlSession

Message = TypeVar("Message")


class OperatorWait:
    """At each tick: begin, then ask is_over until it is.

    Attributes:
        operator_gone: an application in control that owed an answer for too long; nobody waits before its next Command.
    """

    def __init__(self, lost_after_wall_s: float, wall_clock: Callable[[], float] = time.monotonic):
        self._lost_after_wall_s, self._wall_clock = lost_after_wall_s, wall_clock
        self._patient_until = 0.0
        self.operator_gone = False

    def begin(self) -> None:
        """A Status has been published that wants an answer."""
        self._patient_until = self._wall_clock() + self._lost_after_wall_s

    def received(self) -> None:
        """The application in control has sent a Command."""
        self.operator_gone = False
        self.begin()

    def is_over(self, session: ControlSession, status_id: int) -> bool:
        """True when the tick goes on: the Status is answered, or the application in control is gone.

        Without an application in control time stands still until one comes.
        """
        if session.answered_status_id >= status_id:
            return True
        if session.session_id and self._wall_clock() >= self._patient_until:
            self.operator_gone = True
        return bool(session.session_id) and self.operator_gone


class Unread(Generic[Message]):
    """Messages of the link that have come and were not taken yet.

    In lock-step what comes behind the answer to the newest Status belongs to the next tick: an application that hears
    nothing for a second says stop, and it was this process, or another one, that stood meanwhile. Were it taken with
    the answer, how busy the machine is would stop the robot.

    receive: gives what has come, waiting up to so many seconds.
    """

    def __init__(self, receive: Callable[[float], Sequence[Message]]):
        self._receive = receive
        self._messages: Deque[Message] = collections.deque()

    def come(self, timeout_s: float) -> bool:
        """True when there is one; waits only where nothing is left of before."""
        if not self._messages:
            self._messages.extend(self._receive(timeout_s))
        return bool(self._messages)

    def until(self, is_enough: Callable[[], bool]) -> Iterator[Message]:
        """All of them, or those up to the one that is enough."""
        while self._messages and not is_enough():
            yield self._messages.popleft()
