"""How the robot's emergency stop stands, by the motion locks of its owners."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Dict, NamedTuple

from mtr_core.emergency_latch import EmergencyLatch
from mtr_core.liveness import is_fresh

# Age of an owner's newest word at which it counts as silent, and the emergency stop as engaged.
SILENT_AFTER_S = 0.5


class EmergencyStop(enum.IntEnum):
    """As in the link's proto."""

    ABSENT = 1
    RELEASED = 2
    ENGAGED = 3


class Word(NamedTuple):
    """Whether an owner's emergency stop counts as engaged after what it said last, and when on the steady clock."""

    engaged: bool
    said_s: float


class EmergencyWatch:
    """Collects the words of all owners of an emergency stop; one that fell silent while engaged is latched.

    expected: the robot has one; until an owner is received it counts as engaged.
    """

    def __init__(self, expected: bool):
        self._expected = expected
        self._words: Dict[str, Word] = {}
        self._latch = EmergencyLatch(SILENT_AFTER_S)

    def received(self, owner: str, engaged: bool, now_s: float) -> None:
        """An owner says whether its emergency stop is engaged."""
        self._latch.take(owner, engaged, now_s)
        self._words[owner] = Word(owner in self._latch, now_s)

    def at(self, now_s: float) -> EmergencyStop:
        """How it stands; an owner that was received once and is silent counts as engaged."""
        words = list(self._words.values())
        if not words:
            return EmergencyStop.ENGAGED if self._expected else EmergencyStop.ABSENT
        if any(word.engaged or not is_fresh(now_s - word.said_s, SILENT_AFTER_S) for word in words):
            return EmergencyStop.ENGAGED
        return EmergencyStop.RELEASED
