"""What a test is likely to take and to tell, by a model, before it is started and while it runs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Prospect:
    """Of one line, from a Car that is easy to measure to one that is not.

    Attributes:
        attempts: fewest and most: presses, or passes.
        interval_m: half the width of the 95 % interval, narrowest and widest; None when the method gives none.
        line_s: shortest and longest robot time, without the way to its start.
    """

    attempts: tuple[int, int]
    interval_m: tuple[float, float] | None
    line_s: tuple[float, float]

    @property
    def text(self) -> str:
        """For a person."""
        few, many = (str(count) for count in self.attempts)
        attempts = f"attempts on each line: {few if few == many else f'{few} to {many}'}"
        if self.interval_m is None:
            return f"{attempts}; no 95 % interval"
        narrow, wide = (f"\N{PLUS-MINUS SIGN}{half_m:.2f}" for half_m in self.interval_m)
        return f"{attempts}; 95 % interval {narrow if narrow == wide else f'{narrow} to {wide}'} m"
