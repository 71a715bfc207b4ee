"""Emergency stops: who engages one, and who has to be heard so that lift and servos may move."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, Iterable

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
    """The required ones, and each other that was ever heard: one that falls silent stays engaged."""

    def __init__(self, required_owners: Iterable[str], timeout_s: float):
        self._timeout_s = timeout_s
        self._words: Dict[str, EmergencyWord] = {
            owner: EmergencyWord(owner, problems.EMERGENCY_NOT_HEARD(owner=owner), 0, True)
            for owner in required_owners}

    def take(self, word: EmergencyWord) -> bool:
        """Take an owner's word; True when it engages one that was released or never heard."""
        before = self._words.get(word.owner)
        if not word.emergency and before is None:
            return False
        self._words[word.owner] = word
        return bool(word.reason) and not (before and before.reason)

    def reason(self, now_ns: int) -> Problem:
        """Why lift and servos stand still at a time of the steady clock; no problem when they may move."""
        for owner, word in sorted(self._words.items()):
            if word.reason:
                return problems.EMERGENCY_STOP(cause=word.reason)
            if not is_fresh((now_ns - word.steady_stamp_ns) * NS, self._timeout_s):
                return problems.EMERGENCY_STOP(cause=problems.EMERGENCY_SILENT(owner=owner))
        return NO_PROBLEM
