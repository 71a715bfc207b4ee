"""Emergency stops: the engaged ones, and those whose messages lift and servos require."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, Iterable, Optional

from mtr_core.emergency_latch import EmergencyLatch
from mtr_core.liveness import is_fresh
from mtr_core.problems import NO_PROBLEM, Problem

from . import problems

NS = 1e-9


@dataclass(frozen=True)
class EmergencyWord:
    """Message of a motion lock's owner; the reason states why the lock is engaged, no problem if it is released.

    Attributes:
        steady_stamp_ns: its stamp on the steady clock.
        emergency: the lock is an emergency stop.
    """

    owner: str
    reason: Problem
    steady_stamp_ns: int
    emergency: bool


class EmergencyStops:
    """All required emergency stops, and each other one since its first message: a silent one counts as engaged.

    An emergency stop that fell silent while it was engaged is latched, as in drive control.
    """

    def __init__(self, required_owners: Iterable[str], timeout_s: float):
        self._timeout_s = timeout_s
        # None for a required owner without a message yet.
        self._words: Dict[str, Optional[EmergencyWord]] = dict.fromkeys(required_owners)
        self._latch = EmergencyLatch(timeout_s)

    def take(self, word: EmergencyWord) -> bool:
        """Process an owner's message; return True if it engages a released or new emergency stop."""
        if not word.emergency and word.owner not in self._words:
            return False
        was_engaged = word.owner in self._latch
        self._latch.take(word.owner, bool(word.reason), word.steady_stamp_ns * NS)
        self._words[word.owner] = word
        return bool(word.reason) and not was_engaged

    def reason(self, now_ns: int) -> Problem:
        """Return why lift and servos must stop at a time of the steady clock; no problem if they may move."""
        causes = (self._cause(owner, word, now_ns) for owner, word in sorted(self._words.items()))
        cause = next((cause for cause in causes if cause), None)
        return problems.EMERGENCY_STOP(cause=cause) if cause else NO_PROBLEM

    def _cause(self, owner: str, word: Optional[EmergencyWord], now_ns: int) -> Problem:
        if word is None:
            return problems.EMERGENCY_NOT_HEARD(owner=owner)
        if word.reason:
            return word.reason
        if not is_fresh((now_ns - word.steady_stamp_ns) * NS, self._timeout_s):
            return problems.EMERGENCY_SILENT(owner=owner)
        return problems.EMERGENCY_NOT_RELEASED(owner=owner) if owner in self._latch else NO_PROBLEM
