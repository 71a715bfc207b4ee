"""One compared quantity: a distance, a mean over several distances, an area or a coverage."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from mtr_operator.history.estimate import Estimate

from .difference import Change, Difference
from .multiplicity import ALPHA

DISTANCE, NEIGHBOURS, SIDE, AREA, COVERAGE = "distance", "neighbours", "side", "area", "coverage"
UNITS = {DISTANCE: "m", NEIGHBOURS: "m", SIDE: "m", AREA: "m\N{SUPERSCRIPT TWO}", COVERAGE: ""}


@dataclass(frozen=True)
class Row:
    """One quantity in both sets.

    Attributes:
        quantity: DISTANCE, NEIGHBOURS, SIDE, AREA or COVERAGE. lines: numbers of its lines in the first test. name:
            for a person. words: names of its distances. difference: second less first. distances: number of averaged
            distances. is_leading: one of the means with the larger share of the error rate. adjusted: p-value of the
            difference among all rows.
    """

    quantity: str
    lines: tuple[int, ...]
    name: str
    words: tuple[str, ...]
    first: Estimate
    second: Estimate
    difference: Difference
    distances: int = 1
    is_leading: bool = False
    adjusted: float = 1.0

    @property
    def line(self) -> int | None:
        """Number of the line in the first test; None for a quantity of several lines."""
        return self.lines[0] if self.quantity in (DISTANCE, COVERAGE) else None

    @property
    def word(self) -> str:
        """Names of its distances as one text."""
        return " and ".join(self.words)

    @property
    def title(self) -> str:
        """Name, with the number of averaged distances."""
        return f"{self.name} ({self.distances} distances)" if self.quantity in (NEIGHBOURS, SIDE) else self.name

    @property
    def change(self) -> Change:
        """Result for this row alone: different if the whole interval of its difference is on one side of zero."""
        found = self.difference
        if found.reason or (self.first.is_open and self.second.is_open and found.chance > ALPHA
                            and found.value is None):
            return Change.NOT_KNOWN
        if found.low > 0.0:
            return Change.FARTHER
        return Change.NEARER if found.high < 0.0 else Change.NOT_SHOWN

    @property
    def is_different(self) -> bool:
        """True if the row also differs among all rows."""
        return self.change in (Change.FARTHER, Change.NEARER) and self.adjusted <= ALPHA
