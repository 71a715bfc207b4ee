"""Figures of all tests: contacts with the Car and share of measurable lines."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, Iterator, List, Sequence, Tuple

from ..harness.rows import Requirement, Row
from .draw import LOW, WHOLE
from .trial import NEAR_M, CarEnd, LineEnd, refusals

CONTACTS = Requirement("lines on whose ways the robot touched the Car", "(count)", must=0.0)
CARS = Requirement("Cars", "(count)")
ASKED = Requirement("Cars about which the locator asked", "(count)")
# A benchmark in which every line is refused proves nothing.
ORDINARY = Requirement("saloons and hatchbacks with a data sheet: lines measured at 0.3 m", "(share)", must=0.98,
                       at_least=True)
MEASURED = Requirement("all located Cars: lines measured at 1.2 m or nearer", "(share)", must=0.95, at_least=True)
CLEARANCE = Requirement("least distance from a true body", "m")


@dataclass(frozen=True)
class ClearanceFigures:
    """Figures of all Cars; the names are those in the file.

    Attributes:
        measured_at: shares of the lines by class, data sheet and distance.
        refused: refusals by code; a line that is measured from a larger distance may have several.
        contacts: number of the Car, class, data sheet and side of each contact.
    """

    cars: int
    cars_asked: int
    lines: int
    contacts: List[str]
    least_clearance_m: float
    ordinary_at_nearest: float
    measured: float
    measured_at: Dict[str, Dict[str, float]]
    refused: Dict[str, int]
    asked: List[str]

    def rows(self) -> List[Row]:
        """Return the rows of the table."""
        return [Row(CARS, self.cars), Row(CONTACTS, len(self.contacts), remark=f"of {self.lines} lines"),
                Row(CLEARANCE, self.least_clearance_m), Row(ORDINARY, self.ordinary_at_nearest),
                Row(MEASURED, self.measured), Row(ASKED, self.cars_asked)]


def figures(ends: Sequence[CarEnd]) -> ClearanceFigures:
    """Return the figures of these tests."""
    lines = [(end, line) for end in ends for line in end.lines]
    ordinary = [line for end, line in lines if end.drawn.kind in LOW and end.drawn.sheet == WHOLE
                and not (end.drawn.rear_fitting_m and line.side.startswith("rear"))]
    return ClearanceFigures(
        cars=len(ends), cars_asked=sum(bool(end.asked) for end in ends), lines=len(lines),
        contacts=[f"{end.number} {end.drawn.kind}, {end.drawn.sheet}: {line.side}" for end, line in lines
                  if line.clearance_m <= 0.0],
        least_clearance_m=min((line.clearance_m for _, line in lines), default=math.inf),
        ordinary_at_nearest=_share(ordinary, NEAR_M[0]), measured=_share([line for _, line in lines], NEAR_M[-1]),
        measured_at=dict(_by_class(lines)), refused=refusals(list(ends)),
        asked=[f"{end.number} {end.drawn.kind}, {end.drawn.sheet}: {end.asked}" for end in ends if end.asked])


def _share(lines: Sequence[LineEnd], near_m: float) -> float:
    return sum(line.nearest_m <= near_m for line in lines) / len(lines) if lines else math.nan


def _by_class(lines: Sequence[Tuple[CarEnd, LineEnd]]) -> Iterator[Tuple[str, Dict[str, float]]]:
    for key in sorted({(end.drawn.kind, end.drawn.sheet) for end, _ in lines}):
        mine = [line for end, line in lines if (end.drawn.kind, end.drawn.sheet) == key]
        yield ", ".join(key), {f"{near_m:g} m": round(_share(mine, near_m), 3) for near_m in NEAR_M}
