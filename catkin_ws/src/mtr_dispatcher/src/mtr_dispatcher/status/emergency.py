"""State of the robot's emergency stop, from the motion locks of its owners."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Dict, NamedTuple

from mtr_core.emergency_latch import EmergencyLatch
from mtr_core.liveness import is_fresh

# Age of an owner's newest message at which it counts as silent, and the emergency stop as engaged.
SILENT_AFTER_S = 0.5


class EmergencyStop(enum.IntEnum):
    """Values of the link's proto."""

    ABSENT = 1
    RELEASED = 2
    ENGAGED = 3


class Word(NamedTuple):
    """Engagement by an owner's newest message, and its reception time on the steady clock."""

    engaged: bool
    said_s: float


class EmergencyWatch:
    """Collects the messages of all owners of an emergency stop; one that fell silent while engaged is latched.

    expected: the robot has an emergency stop; until an owner's first message it counts as engaged.
    """

    def __init__(self, expected: bool):
        self._expected = expected
        self._words: Dict[str, Word] = {}
        self._latch = EmergencyLatch(SILENT_AFTER_S)

    def received(self, owner: str, engaged: bool, now_s: float) -> None:
        """Process an owner's message."""
        self._latch.take(owner, engaged, now_s)
        self._words[owner] = Word(owner in self._latch, now_s)

    def at(self, now_s: float) -> EmergencyStop:
        """Return the state; a known owner that is silent counts as engaged."""
        words = list(self._words.values())
        if not words:
            return EmergencyStop.ENGAGED if self._expected else EmergencyStop.ABSENT
        if any(word.engaged or not is_fresh(now_s - word.said_s, SILENT_AFTER_S) for word in words):
            return EmergencyStop.ENGAGED
        return EmergencyStop.RELEASED
