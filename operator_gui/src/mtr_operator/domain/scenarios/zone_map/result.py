"""What Zone map records of one zone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...estimation.interval import SIGMAS_OF_LEVEL
from ...results.document import Floats, OptionalFloat, Texts
from ...results.line_result import LineResult, LineStatus, MeasuredDistance, boundary, column, stored

REACH = "reach"
_HALF = "distance from the Car's outline, in the middle of the zone, at which half of the presses work"


@dataclass(frozen=True)
class ZoneMapResult(LineResult):
    """Distances are those of the Remote key from the Car's outline, away from its centre."""

    zone: int = column("number of the zone, clockwise from the Car's front, then the next height")
    side: str = column("side or corner of the Car")
    height_m: float = column("height of the Remote key above ground", "m")
    status: LineStatus = column("ok, not_reached or invalid")
    presses: int = column("presses in this zone")
    distance_m: OptionalFloat = column(_HALF, "m", default=None)
    low_m: OptionalFloat = column(f"lower end of the 95 % interval of the {_HALF}, empty when it lies nearer", "m",
                                  default=None)
    high_m: OptionalFloat = column(f"upper end of the 95 % interval of the {_HALF}, empty when it lies farther", "m",
                                   default=None)
    uncertainty_m: OptionalFloat = column("1 sigma of the places of the presses", "m", default=None)
    coverage: OptionalFloat = column("part of the zone's area where at least half of the presses work", default=None)
    coverage_low: OptionalFloat = column("lower end of the 95 % interval of the coverage", default=None)
    coverage_high: OptionalFloat = column("upper end of the 95 % interval of the coverage", default=None)
    reason: str = stored("")
    worked_x_m: Floats = stored(())
    worked_y_m: Floats = stored(())
    failed_x_m: Floats = stored(())
    failed_y_m: Floats = stored(())
    evidence: Texts = stored(())

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.zone

    @property
    def place(self) -> str:
        """See LineResult."""
        return self.side.replace("_", " ")

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: how far half of the presses work."""
        low_m, high_m = self.low_m, self.high_m
        sigma_m = None if low_m is None or high_m is None else (high_m - low_m) / (2.0 * SIGMAS_OF_LEVEL)
        return (boundary(REACH, self.status, self.distance_m, sigma_m, (low_m, high_m)),)

    @property
    def is_silent(self) -> bool:
        """Nothing worked, and nobody knows why: it says nothing of other zones."""
        return self.status is LineStatus.INVALID and not self.worked_x_m

    @property
    def worked(self) -> tuple[tuple[float, float], ...]:
        """Places at which a press worked, in the Car coordinate system."""
        return tuple(zip(self.worked_x_m, self.worked_y_m))

    @property
    def failed(self) -> tuple[tuple[float, float], ...]:
        """Places at which a press failed."""
        return tuple(zip(self.failed_x_m, self.failed_y_m))
