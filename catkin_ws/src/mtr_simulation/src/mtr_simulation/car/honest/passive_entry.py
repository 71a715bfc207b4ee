"""Passive entry: consecutive agreeing polls change the key's presence, which unlocks and locks."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Optional

from ..ecu import Command
from .parameters import PassiveParameters


class Poll(enum.Enum):
    """Result of one poll."""

    IN_UNLOCK_ZONE = "unlock zone"
    BETWEEN = "between"  # within the lock zone only
    GONE = "gone"


class PassiveEntry:
    """Debounced presence of the key.

    Attributes:
        is_near: the key has arrived and has not left since.
    """

    def __init__(self, parameters: PassiveParameters):
        self._parameters = parameters
        self._agreeing = 0
        self._left_ns: Optional[int] = None
        self.is_near = False

    def poll(self, answer: Poll, time_ns: int) -> Optional[Command]:
        """Process one poll; return the resulting command, if any."""
        p = self._parameters
        departed = answer is Poll.GONE if p.walk_away == "distance" else answer is not Poll.IN_UNLOCK_ZONE
        changes = departed if self.is_near else answer is Poll.IN_UNLOCK_ZONE
        self._agreeing = self._agreeing + 1 if changes else 0
        if self._agreeing >= p.debounce_polls:
            self._agreeing = 0
            self.is_near = not self.is_near
            return self._arrived() if self.is_near else self._departed(time_ns)
        return self._after_delay(time_ns)

    def _arrived(self) -> Optional[Command]:
        self._left_ns = None
        return Command.UNLOCK if self._parameters.unlock_on == "approach" else None

    def _departed(self, time_ns: int) -> Optional[Command]:
        if self._parameters.walk_away == "delay":
            self._left_ns = time_ns
            return self._after_delay(time_ns)
        return Command.LOCK if self._parameters.walk_away == "distance" else None

    def _after_delay(self, time_ns: int) -> Optional[Command]:
        if self._left_ns is None or time_ns - self._left_ns < self._parameters.walk_away_delay_s * 1e9:
            return None
        self._left_ns = None
        return Command.LOCK
