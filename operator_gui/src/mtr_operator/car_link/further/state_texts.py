"""Compares the states of a profile with the texts that its CAN database gives to the same values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Iterator

from mtr_operator.domain.ports import LockState

from ..profile import CarProfile

# Texts in English and German; a text with neither word, or with both, is not compared.
_WORDS = {LockState.UNLOCKED: re.compile(r"(?i)(?<![a-z])(unlock|not?[ _-]?lock|entriegel|entsperr)"),
          LockState.LOCKED: re.compile(r"(?i)(?<![a-z])(?<!not)(?<!not[ _-])(?<!no[ _-])(lock|verriegel|gesperrt)")}


def contradictions(profile: CarProfile) -> Iterator[str]:
    """Yield sentences on values that the database describes as the opposite state: one of the two is wrong."""
    names = profile.door_signals.values() or [profile.signal]
    for signal in (each for each in profile.message.signals if each.name in names):
        for raw, text in (signal.choices or {}).items():
            state, described = profile.states.get(int(raw)), _described(str(text))
            if {state, described} == set(_WORDS):
                assert state is not None
                yield (f"states has {raw}: {state.value}, and the CAN database describes {raw} of the signal "
                       f"{signal.name} as {str(text)!r}; check on the Car which is right.")


def _described(text: str) -> LockState | None:
    found = [state for state, words in _WORDS.items() if words.search(text)]
    return found[0] if len(found) == 1 else None
