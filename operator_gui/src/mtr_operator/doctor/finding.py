"""Result of one check of the computer, its files, or the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping

from mtr_operator.station.checks.finding import State

# First word of a printed line.
SIGNS: Mapping[State, str] = {State.GOOD: "ok", State.NOTE: "note", State.UNKNOWN: "unknown", State.BAD: "bad"}


@dataclass(frozen=True)
class Finding:
    """Result of a check. what: a word or two. sentence: the state, or the fault and its remedy."""

    what: str
    state: State
    sentence: str

    def line(self, signs: Mapping[State, str] = SIGNS) -> str:
        """Return the line for a terminal."""
        return f"{signs[self.state]:<8}{self.what}: {' '.join(self.sentence.split())}"
