"""Acoustic alerts for the Operator, who watches Car and robot instead of the screen."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from .readiness import Phase, ReadinessWord


class Alert(enum.Enum):
    """Alerts; the value is the number of beeps."""

    MOVES = 1
    DONE = 2
    TROUBLE = 3
    ASKED = 4


@dataclass(frozen=True)
class Heard:
    """Inputs of the alert decision. has_trouble: the test was interrupted, but not by the Operator. is_asked: the
    Operator must confirm presence."""

    may_move: bool
    word: ReadinessWord
    phase: Phase
    has_trouble: bool
    is_asked: bool = False


def alert_of(before: Heard, now: Heard) -> Alert | None:
    """Return the alert for the transition between two states; the most severe one."""
    if now.has_trouble and not before.has_trouble:
        return Alert.TROUBLE
    is_bad = now.word in (ReadinessWord.BLOCKED, ReadinessWord.LOST)
    if is_bad and before.word is not now.word and (before.may_move or now.may_move):
        return Alert.TROUBLE
    if now.is_asked and not before.is_asked:
        return Alert.ASKED
    if now.phase is Phase.FINISHED and before.phase in (Phase.MEASURING, Phase.STOPPING):
        return Alert.DONE
    return Alert.MOVES if now.may_move and not before.may_move else None
