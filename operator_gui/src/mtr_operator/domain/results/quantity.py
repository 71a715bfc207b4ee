"""What a limit may be about beside the distances of a line: a time, an error, a probability."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from .document import OptionalFloat


@dataclass(frozen=True)
class Quantity:
    """As a scenario has it, with its parameters.

    Attributes:
        word: what it is called in a limits file. keys: entries of such a file that may limit it.
        low, high: limits that its results can keep and break lie between these, ends included, in the unit of the keys.
    """

    word: str
    keys: tuple[str, ...]
    low: float
    high: float


@dataclass(frozen=True)
class MeasuredQuantity:
    """Of one line, in the unit of its limits.

    Attributes:
        low, high: ends of its interval; None for one that is open, and both where the line does not tell it.
        middle: best estimate, None where nothing is known but the ends.
        distance_word: the distance of the line whose errors that no repetition shows widen the interval; empty where
            there is none.
        is_magnitude: what is limited is how far it is from 0, whichever way.
    """

    word: str
    low: OptionalFloat
    high: OptionalFloat
    middle: OptionalFloat = None
    distance_word: str = ""
    is_magnitude: bool = False

    @property
    def is_known(self) -> bool:
        """The line tells something of it."""
        return self.low is not None or self.high is not None
