"""What a test is likely to take and to tell, by a model, before it is started and while it runs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Forecast:
    """Of one line, from a Car that is easy to measure to one that is not.

    Attributes:
        attempts: fewest and most: presses, or passes.
        interval_m: half the width of the 95 % interval of the distance that a line is measured for, narrowest and
            widest; None when the method gives none, or promises none of a distance.
        line_s: shortest and longest robot time, without the way to its start.
        coverage_percent: the same half widths of the part of a zone that is covered; None of all but zones.
    """

    attempts: tuple[int, int]
    interval_m: tuple[float, float] | None
    line_s: tuple[float, float]
    coverage_percent: tuple[float, float] | None = None

    @property
    def text(self) -> str:
        """For a person."""
        few, many = map(str, self.attempts)
        attempts = f"attempts on each line: {_span(few, many)}"
        if self.coverage_percent is not None:
            narrow, wide = (f"\N{PLUS-MINUS SIGN}{half:.0f}" for half in self.coverage_percent)
            return f"{attempts}; 95 % interval of the coverage {_span(narrow, wide)} %"
        if self.interval_m is None:
            return f"{attempts}; no 95 % interval"
        narrow, wide = (f"\N{PLUS-MINUS SIGN}{half_m:.2f}" for half_m in self.interval_m)
        return f"{attempts}; 95 % interval {_span(narrow, wide)} m"


def _span(low: str, high: str) -> str:
    return low if low == high else f"{low} to {high}"
