"""Event-based simulation of the honest Car without bus and contacts, for studies of the radio; hundreds of times
faster."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, List, NamedTuple, Optional, Tuple

from ..ecu import Command
from ..noise import uniform_pair
from .attempts import Attempts
from .frames import LOCK_MESSAGE, ON_CHANGE_NS, phase_ns
from .key import RemoteKey
from .locks import Cause, Locks, LockState
from .margins import Margins
from .parameters import HonestParameters
from .passive_entry import PassiveEntry, Poll
from .radio.key_antenna import Attitude

Point = Tuple[float, float, float]

# Step of the Car; all events occur at a step.
STEP_NS = 20_000_000
_MS = 1_000_000


class Moved(NamedTuple):
    """Movement of the locks that the lock message has reported.

    Attributes:
        told_ns: first frame with the new state. before_ns: last frame with the old one; equal for a message that is
            sent on change.
    """

    time_ns: int
    state: LockState
    cause: Cause
    told_ns: int
    before_ns: int


class HonestInstants:
    """Honest Car that is evaluated at instants, which must be in order of time on the grid of the Car's steps.

    Attributes:
        margins: radio margins at any place.
        contact_ns: minimum duration of a button press.
    """

    def __init__(self, seed: int, parameters: HonestParameters):
        passive = parameters.passive_entry
        self.margins = Margins(parameters)
        self.contact_ns = -(-parameters.key.contact_ms * _MS // STEP_NS) * STEP_NS
        self._is_polling = passive.enabled
        self._bus = parameters.bus
        self._cycle_ns = parameters.bus.lock_cycle_ms * _MS
        self._bus_phase_ns = phase_ns(seed, LOCK_MESSAGE, self._cycle_ns)
        self._poll_ns = passive.poll_period_ms * _MS
        self._poll_phase_ns = round(uniform_pair(seed, "poll_phase", 0)[0] * self._poll_ns)
        self._attempts = Attempts(seed, parameters)
        self._passive = PassiveEntry(passive)
        self._locks = Locks(parameters.locks)
        self._key = RemoteKey(parameters.key)
        self._moved: List[Moved] = []

    @property
    def due_ns(self) -> Optional[int]:
        """Time of the next event of the locks; None without one."""
        return self._due()

    def polls_ns(self, after_ns: int, until_ns: int) -> List[int]:
        """Return the times of the polls after after_ns up to until_ns."""
        if not self._is_polling:
            return []
        first, last = self._polls_until(after_ns) + 1, self._polls_until(until_ns)
        return [_on_grid(number * self._poll_ns + self._poll_phase_ns) for number in range(first, last + 1)]

    def next_poll_ns(self, after_ns: int) -> Optional[int]:
        """Return the first poll after an instant; None if the Car never polls."""
        if not self._is_polling:
            return None
        return _on_grid((self._polls_until(after_ns) + 1) * self._poll_ns + self._poll_phase_ns)

    def next_polls_ns(self, after_ns: int, count: int) -> List[int]:
        """Return the first polls after an instant; empty if the Car never polls."""
        if not self._is_polling:
            return []
        first_ns = (self._polls_until(after_ns) + 1) * self._poll_ns + self._poll_phase_ns
        return [_on_grid(first_ns + number * self._poll_ns) for number in range(count)]

    def poll(self, time_ns: int, key_xyz: Point, field_db: float, answer_db: Callable[[], float]) -> None:
        """Poll the key at a place with these margins, see Margins."""
        if not self._advance(time_ns, key_xyz):
            return
        answer = self._attempts.judge_poll(field_db, answer_db) if self._key.is_awake else Poll.GONE
        command = self._passive.poll(answer, time_ns)
        if command is not None:
            self._locks.command(command, Cause.PASSIVE_ENTRY, time_ns)

    def press(self, time_ns: int, command: Command, key_xyz: Point, attitude: Attitude) -> bool:
        """Press a button; return True if the press is received."""
        is_ready = self._advance(time_ns, key_xyz)
        accepted = is_ready and self._key.buttons_work and self._attempts.press(key_xyz, attitude)
        if accepted:
            self._locks.command(command, Cause.KEY_BUTTON, time_ns)
        return accepted

    def take_handle(self, time_ns: int, key_xyz: Point, attitude: Attitude) -> bool:
        """Pull the driver's handle; return True if the key is found and the Car unlocks."""
        if not (self._advance(time_ns, key_xyz) and self._is_polling and self._key.is_awake):
            return False
        accepted = self._attempts.poll(key_xyz, attitude) is Poll.IN_UNLOCK_ZONE
        if accepted:
            self._locks.command(Command.UNLOCK, Cause.HANDLE, time_ns)
        return accepted

    def pass_time(self, time_ns: int) -> List[Moved]:
        """Let the locks move up to an instant; return their movements since the last call."""
        due_ns = self._due()
        while due_ns is not None and due_ns <= time_ns:
            state = self._locks.step(due_ns)
            if state is not None:
                self._moved.append(self._told(due_ns, state))
            due_ns = self._due()
        if not self._moved:
            return []
        moved, self._moved = self._moved, []
        return moved

    def _polls_until(self, time_ns: int) -> int:
        """Return the number of the last poll up to a time. A poll that is delayed to the next step counts as later."""
        return (time_ns - time_ns % STEP_NS - self._poll_phase_ns) // self._poll_ns

    def _advance(self, time_ns: int, key_xyz: Point) -> bool:
        """Advance to an instant; return True if the ECU has booted."""
        self._moved = self.pass_time(time_ns)
        self._locks.step(time_ns)
        self._attempts.step(time_ns)
        self._key.step(time_ns, key_xyz)
        return self._locks.is_ready

    def _due(self) -> Optional[int]:
        due_ns = self._locks.due_ns
        return None if due_ns is None else _on_grid(due_ns)

    def _told(self, time_ns: int, state: LockState) -> Moved:
        """Return the reported movement. Frames have the state at the beginning of their step, so a change shows in a
        later one."""
        number = (time_ns - self._bus_phase_ns) // self._cycle_ns
        before_ns = number * self._cycle_ns + self._bus_phase_ns
        told_ns = before_ns + self._cycle_ns
        if self._bus.sent_on_change and time_ns + ON_CHANGE_NS < told_ns:
            told_ns = before_ns = time_ns + ON_CHANGE_NS
        return Moved(time_ns, state, self._locks.cause, told_ns, before_ns)


def _on_grid(time_ns: int) -> int:
    """Return the Car's first step that is not earlier."""
    return -(-time_ns // STEP_NS) * STEP_NS
