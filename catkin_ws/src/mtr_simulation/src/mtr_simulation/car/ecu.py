"""Body ECU of the simulated Car: central locking, commanded by passive entry and key buttons."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Optional

from .parameters import PassiveEntryParameters

# Time for which LockStateChanged stays set in the frames after a change.
CHANGED_FLAG_NS = 100_000_000


class LockState(enum.IntEnum):
    """Values of the DBC's LockState."""

    LOCKED = 0
    UNLOCKED = 1
    UNKNOWN = 2


class Command(enum.IntEnum):
    """Commands to the central locking."""

    LOCK = 0
    UNLOCK = 1


class Source(enum.IntEnum):
    """Values of the DBC's LastCommandSource."""

    NONE = 0
    PASSIVE_ENTRY = 1
    KEY_BUTTON = 2


_STATE_AFTER = {Command.LOCK: LockState.LOCKED, Command.UNLOCK: LockState.UNLOCKED}


class BodyEcu:
    """State of the locks.

    Attributes:
        lock_state: UNKNOWN until the ECU has booted.
        last_source: source of the last accepted command.
        command_counter: number of accepted commands, including those without a change.
    """

    def __init__(self, boot_ns: int):
        self.lock_state = LockState.UNKNOWN
        self.last_source = Source.NONE
        self.command_counter = 0
        self._boot_ns = boot_ns
        self._ready_ns: Optional[int] = None
        self._changed_ns: Optional[int] = None

    def step(self, time_ns: int) -> None:
        """Advance the time; the first step switches the ECU on, with locked doors after booting."""
        if self._ready_ns is None:
            self._ready_ns = time_ns + self._boot_ns
        if self.lock_state is LockState.UNKNOWN and time_ns >= self._ready_ns:
            self.lock_state = LockState.LOCKED

    def command(self, command: Command, source: Source, time_ns: int) -> bool:
        """Execute a command; return True if the locks moved. Commands are ignored until the ECU has booted."""
        if self.lock_state is LockState.UNKNOWN:
            return False
        self.command_counter += 1
        self.last_source = source
        after = _STATE_AFTER[command]
        if after is self.lock_state:
            return False
        self.lock_state = after
        self._changed_ns = time_ns
        return True

    def has_just_changed(self, time_ns: int) -> bool:
        """Return True within 100 ms after a change of the lock state."""
        return self._changed_ns is not None and time_ns - self._changed_ns < CHANGED_FLAG_NS


class PassiveEntry:
    """Converts polled field strengths to commands, one per arrival and one per departure of the key.

    Between the two thresholds nothing changes. A departure without an arrival gives no command, so that a Car that was
    unlocked by a button from a distance stays unlocked.
    """

    def __init__(self, parameters: PassiveEntryParameters):
        self._parameters = parameters
        self._near = False
        self._agreeing_polls = 0

    def poll(self, strength_db: float) -> Optional[Command]:
        """Process one poll; return the resulting command, if any."""
        p = self._parameters
        departs = self._near and strength_db < p.lock_threshold_db
        arrives = not self._near and strength_db > p.unlock_threshold_db
        self._agreeing_polls = self._agreeing_polls + 1 if departs or arrives else 0
        if self._agreeing_polls < p.debounce_polls:
            return None
        self._agreeing_polls = 0
        self._near = not self._near
        return Command.UNLOCK if self._near else Command.LOCK
