"""The honest Car followed from instant to instant, without bus and contacts: what is left of it where only the radio
matters, hundreds of times quicker than step by step."""
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

# The Car's own steps: whatever happens, happens at one of them.
STEP_NS = 20_000_000
_MS = 1_000_000


class Moved(NamedTuple):
    """The locks moved, and the lock message told it.

    Attributes:
        told_ns: first frame with the new state. before_ns: last frame with the old one; the same for a message that is
            sent on change.
    """

    time_ns: int
    state: LockState
    cause: Cause
    told_ns: int
    before_ns: int


class HonestInstants:
    """Instants have to come in order of time, on the grid of the Car's steps.

    Attributes:
        margins: of the radio at any place.
        contact_ns: a button has to be held so long.
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
        """When the locks do something by themselves; None when they will not."""
        return self._due()

    def polls_ns(self, after_ns: int, until_ns: int) -> List[int]:
        """When it looks for its key, later than one instant and not later than another."""
        if not self._is_polling:
            return []
        first, last = self._polls_until(after_ns) + 1, self._polls_until(until_ns)
        return [_on_grid(number * self._poll_ns + self._poll_phase_ns) for number in range(first, last + 1)]

    def next_poll_ns(self, after_ns: int) -> Optional[int]:
        """The first one later than an instant; None where it never looks."""
        if not self._is_polling:
            return None
        return _on_grid((self._polls_until(after_ns) + 1) * self._poll_ns + self._poll_phase_ns)

    def next_polls_ns(self, after_ns: int, count: int) -> List[int]:
        """The first ones; none where it never looks."""
        if not self._is_polling:
            return []
        first_ns = (self._polls_until(after_ns) + 1) * self._poll_ns + self._poll_phase_ns
        return [_on_grid(first_ns + number * self._poll_ns) for number in range(count)]

    def poll(self, time_ns: int, key_xyz: Point, field_db: float, answer_db: Callable[[], float]) -> None:
        """It looks for its key at a place of these margins: see Margins."""
        if not self._advance(time_ns, key_xyz):
            return
        answer = self._attempts.judge_poll(field_db, answer_db) if self._key.is_awake else Poll.GONE
        command = self._passive.poll(answer, time_ns)
        if command is not None:
            self._locks.command(command, Cause.PASSIVE_ENTRY, time_ns)

    def press(self, time_ns: int, command: Command, key_xyz: Point, attitude: Attitude) -> bool:
        """A button is pressed; True when the press is received."""
        is_ready = self._advance(time_ns, key_xyz)
        accepted = is_ready and self._key.buttons_work and self._attempts.press(key_xyz, attitude)
        if accepted:
            self._locks.command(command, Cause.KEY_BUTTON, time_ns)
        return accepted

    def take_handle(self, time_ns: int, key_xyz: Point, attitude: Attitude) -> bool:
        """A hand takes the driver's handle; True when the key is found and the Car unlocks."""
        if not (self._advance(time_ns, key_xyz) and self._is_polling and self._key.is_awake):
            return False
        accepted = self._attempts.poll(key_xyz, attitude) is Poll.IN_UNLOCK_ZONE
        if accepted:
            self._locks.command(Command.UNLOCK, Cause.HANDLE, time_ns)
        return accepted

    def pass_time(self, time_ns: int) -> List[Moved]:
        """Let the locks move up to an instant; what they did since the last call."""
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
        """Number of the last poll not later. One that is put off to the next step is later than the step before."""
        return (time_ns - time_ns % STEP_NS - self._poll_phase_ns) // self._poll_ns

    def _advance(self, time_ns: int, key_xyz: Point) -> bool:
        """To an instant; True when the ECU has booted."""
        self._moved = self.pass_time(time_ns)
        self._locks.step(time_ns)
        self._attempts.step(time_ns)
        self._key.step(time_ns, key_xyz)
        return self._locks.is_ready

    def _due(self) -> Optional[int]:
        due_ns = self._locks.due_ns
        return None if due_ns is None else _on_grid(due_ns)

    def _told(self, time_ns: int, state: LockState) -> Moved:
        """Frames carry the state at the beginning of their step, so that the step of the change tells the old one."""
        number = (time_ns - self._bus_phase_ns) // self._cycle_ns
        before_ns = number * self._cycle_ns + self._bus_phase_ns
        told_ns = before_ns + self._cycle_ns
        if self._bus.sent_on_change and time_ns + ON_CHANGE_NS < told_ns:
            told_ns = before_ns = time_ns + ON_CHANGE_NS
        return Moved(time_ns, state, self._locks.cause, told_ns, before_ns)


def _on_grid(time_ns: int) -> int:
    """The Car's first step not earlier."""
    return -(-time_ns // STEP_NS) * STEP_NS
