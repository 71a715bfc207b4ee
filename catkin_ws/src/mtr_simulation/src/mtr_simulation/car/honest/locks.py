"""Central locking: doors, causes, motor times, the relock timer, and a key that was left inside."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import NamedTuple, Optional

from ..ecu import Command
from .parameters import LockParameters


class LockState(enum.IntEnum):
    """Values of LockState in the honest Car's DBC."""

    LOCKED = 0
    DRIVER_UNLOCKED = 1
    UNLOCKED = 2
    UNKNOWN = 7


class Cause(enum.IntEnum):
    """Values of LockCause in the honest Car's DBC."""

    NONE = 0
    PASSIVE_ENTRY = 1
    KEY_BUTTON = 2
    RELOCK_TIMER = 3
    HANDLE = 4


# Causes that a second key inside prevents from locking; a button press is intentional and is executed.
_STOPPED_BY_SECOND_KEY = (Cause.PASSIVE_ENTRY, Cause.RELOCK_TIMER, Cause.HANDLE)


class _Ordered(NamedTuple):
    due_ns: int
    state: LockState
    cause: Cause


class Locks:
    """State of the locks.

    Attributes:
        state: UNKNOWN until the ECU has booted, then locked.
        cause: cause of the last change.
        events: number of changes of the state.
        changed_ns: time of the last change; None before the first.
    """

    def __init__(self, parameters: LockParameters):
        self._parameters = parameters
        self.state = LockState.UNKNOWN
        self.cause = Cause.NONE
        self.events = 0
        self.changed_ns: Optional[int] = None
        self._ready_ns: Optional[int] = None
        self._ordered: Optional[_Ordered] = None
        self._relock_ns: Optional[int] = None

    @property
    def is_ready(self) -> bool:
        """True if the ECU has booted."""
        return self.state is not LockState.UNKNOWN

    @property
    def due_ns(self) -> Optional[int]:
        """Time of the next autonomous change; None without one. Known from the first step on."""
        if not self.is_ready:
            return self._ready_ns
        ordered, relock_ns = self._ordered, self._relock_ns
        if ordered is None or (relock_ns is not None and relock_ns < ordered.due_ns):
            return relock_ns
        return ordered.due_ns

    def command(self, command: Command, cause: Cause, time_ns: int) -> bool:
        """Command the locks; return False if the command is rejected or changes nothing."""
        after = self._after(command, cause)
        ahead = self.state if self._ordered is None else self._ordered.state
        if not self.is_ready or after is None or after is ahead:
            return False
        self._ordered = _Ordered(time_ns + self._parameters.actuator_ms * 1_000_000, after, cause)
        return True

    def step(self, time_ns: int) -> Optional[LockState]:
        """Advance the time; return the state to which the locks have moved in this step, if any."""
        if self._ready_ns is None:
            self._ready_ns = time_ns + self._parameters.boot_ms * 1_000_000
        if not self.is_ready:
            self.state = LockState.LOCKED if time_ns >= self._ready_ns else LockState.UNKNOWN
            return None
        if self._relock_ns is not None and time_ns >= self._relock_ns:
            self._relock_ns = None
            self.command(Command.LOCK, Cause.RELOCK_TIMER, time_ns)
        return self._moved(time_ns)

    def _moved(self, time_ns: int) -> Optional[LockState]:
        ordered = self._ordered
        if ordered is None or time_ns < ordered.due_ns:
            return None
        self._ordered = None
        self.state, self.cause, self.changed_ns = ordered.state, ordered.cause, time_ns
        self.events += 1
        relocks = self.state is not LockState.LOCKED and self._parameters.relock_s > 0.0
        self._relock_ns = time_ns + round(self._parameters.relock_s * 1e9) if relocks else None
        return self.state

    def _after(self, command: Command, cause: Cause) -> Optional[LockState]:
        """Return the state after a command; None if it is rejected."""
        if command is Command.LOCK:
            refused = self._parameters.second_key_inside and cause in _STOPPED_BY_SECOND_KEY
            return None if refused else LockState.LOCKED
        if self._parameters.unlock_doors == "all" or self.state is LockState.UNLOCKED:
            return LockState.UNLOCKED
        # The second press of the button also unlocks the other doors.
        again = cause is Cause.KEY_BUTTON and self.state is LockState.DRIVER_UNLOCKED
        return LockState.UNLOCKED if again else LockState.DRIVER_UNLOCKED
