"""Emergency stops: who engages one, and who has to be heard so that lift and servos may move."""
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
    """What an owner of a motion lock says; the reason says why it is engaged, no problem when it is not.

    Attributes:
        steady_stamp_ns: when, on the steady clock.
        emergency: it is an emergency stop.
    """

    owner: str
    reason: Problem
    steady_stamp_ns: int
    emergency: bool


class EmergencyStops:
    """The required ones, and each other that was ever heard: one that falls silent stays engaged.

    One that fell silent while it was engaged is latched, as in drive control.
    """

    def __init__(self, required_owners: Iterable[str], timeout_s: float):
        self._timeout_s = timeout_s
        # Nothing of a required owner that was not heard yet.
        self._words: Dict[str, Optional[EmergencyWord]] = dict.fromkeys(required_owners)
        self._latch = EmergencyLatch(timeout_s)

    def take(self, word: EmergencyWord) -> bool:
        """Take an owner's word; True when it engages one that was released or never heard."""
        if not word.emergency and word.owner not in self._words:
            return False
        was_engaged = word.owner in self._latch
        self._latch.take(word.owner, bool(word.reason), word.steady_stamp_ns * NS)
        self._words[word.owner] = word
        return bool(word.reason) and not was_engaged

    def reason(self, now_ns: int) -> Problem:
        """Why lift and servos stand still at a time of the steady clock; no problem when they may move."""
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
