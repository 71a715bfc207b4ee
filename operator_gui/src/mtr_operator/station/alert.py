"""When the Operator, who looks at Car and robot, has to hear something."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from .readiness import Phase, ReadinessWord


class Alert(enum.Enum):
    """The value says how many beeps it is."""

    MOVES = 1
    DONE = 2
    TROUBLE = 3
    ASKED = 4


@dataclass(frozen=True)
class Heard:
    """What decides on an alert. has_trouble: the test was interrupted, and not by the Operator. is_asked: the
    Operator has to confirm to be present."""

    may_move: bool
    word: ReadinessWord
    phase: Phase
    has_trouble: bool
    is_asked: bool = False


def alert_of(before: Heard, now: Heard) -> Alert | None:
    """What is to be heard when one state follows another; the worst of it."""
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
