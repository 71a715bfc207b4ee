"""What Key press records of one radial."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..results.carried import CAUSE_DOC, DOORS_DOC, HEADING_DOC, HEIGHT_DOC, KEY_NUMBER_DOC, LATERAL_DOC, SPEED_DOC
from ..results.document import Floats, OptionalFloat, OptionalInt, Texts
from ..results.line_result import LineStatus, MeasuredDistance, column, stored
from .line_search.result import SearchColumns, SearchedResult

PRESS = "press"
# Of another press at the place of one that worked.
CONFIRMING = "confirming press"
SCAN, ADAPTIVE = "scan", "adaptive"
_SEARCH = SearchColumns("presses", "radials")


@dataclass(frozen=True)
class KeyPressResult(SearchedResult):
    """Distances are those of the Remote key from the Car's centre, along the radial."""

    WORD = PRESS
    FILE_ORDER = ("radial", "angle_deg", "status", "distance_m", "uncertainty_m", "robot_time_s", "failed_distance_m",
                  "attempts", "reason", "lateral_offset_m", "heading_offset_deg", "key_height_m", "speed_mps", "cause",
                  "method", "reach", "d50_m", "d50_sigma_m", "d50_low_m", "d50_high_m", "d95_m", "d95_low_m",
                  "d95_high_m", "nearest_failure_m", "holes_m", "lapse", "fit_quality", "unconfirmed_m",
                  "key_number", "doors", "worked_at_m", "failed_at_m", "place_sigma_m", "evidence",
                  "wanted_interval_m", "boundaries", "hole_from_m", "hole_to_m", "look_shares", "look_spent",
                  "d50_look_low_m", "d50_look_high_m", "d95_look_low_m", "d95_look_high_m")

    radial: int = column("number of the radial, clockwise from the Car's front")
    angle_deg: float = column("angle of the radial, clockwise from the Car's front", "deg", digits=3)
    status: LineStatus = column("ok, not_reached or invalid")
    distance_m: OptionalFloat = column("Remote key from the Car's centre at the farthest press that worked", "m")
    failed_distance_m: OptionalFloat = column(
        "the next farther place that failed, empty if none; with not_reached the nearest place that failed", "m")
    uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    attempts: int = column("presses on this radial")
    robot_time_s: OptionalFloat = column(
        "robot's clock when the button of the press that worked went down", "s", digits=3)
    reason: str = stored()
    lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} at the press that worked", "m", default=None)
    heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} at the press that worked", "deg", 2, None)
    key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} at the press that worked", "m", default=None)
    speed_mps: OptionalFloat = column(f"{SPEED_DOC} at the press that worked", "m/s", default=None)
    cause: str = column(f"what the Car obeyed: {CAUSE_DOC}", default="")
    method: str = column("scan: from far to near until a press works; adaptive: search with intervals", default=SCAN)
    reach: str = column("adaptive: where the boundary lies: measured; nearer than the nearest place; farther than the "
                        "farthest one; no_answer: nobody knows", default="")
    d50_m: OptionalFloat = _SEARCH.d50_m
    d50_sigma_m: OptionalFloat = _SEARCH.d50_sigma_m
    d50_low_m: OptionalFloat = _SEARCH.d50_low_m
    d50_high_m: OptionalFloat = _SEARCH.d50_high_m
    d95_m: OptionalFloat = _SEARCH.d95_m
    d95_low_m: OptionalFloat = _SEARCH.d95_low_m
    d95_high_m: OptionalFloat = _SEARCH.d95_high_m
    nearest_failure_m: OptionalFloat = column("nearest press that failed", "m", default=None)
    holes_m: str = column("places that failed again and again although farther ones worked", "m", default="")
    lapse: OptionalFloat = _SEARCH.lapse
    fit_quality: OptionalFloat = _SEARCH.fit_quality
    unconfirmed_m: str = _SEARCH.unconfirmed_m
    key_number: OptionalInt = column(f"of cause: {KEY_NUMBER_DOC}", default=None)
    doors: str = column(f"of the press that worked: {DOORS_DOC}", default="")
    worked_at_m: Floats = stored(())
    failed_at_m: Floats = stored(())
    place_sigma_m: OptionalFloat = stored(None)
    evidence: Texts = stored(())
    wanted_interval_m: OptionalFloat = stored(None)
    boundaries: str = stored("")
    hole_from_m: OptionalFloat = stored(None)
    hole_to_m: OptionalFloat = stored(None)
    look_shares: Floats = stored(())
    look_spent: Floats = stored(())
    d50_look_low_m: OptionalFloat = stored(None)
    d50_look_high_m: OptionalFloat = stored(None)
    d95_look_low_m: OptionalFloat = stored(None)
    d95_look_high_m: OptionalFloat = stored(None)

    @property
    def was_searched(self) -> bool:
        """See SearchedResult."""
        return self.method == ADAPTIVE

    @property
    def is_possible(self) -> bool:
        """See LineResult."""
        return self.method in (SCAN, ADAPTIVE) and super().is_possible

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.radial

    @property
    def place(self) -> str:
        """See LineResult."""
        return f"{self.angle_deg:g}\N{DEGREE SIGN}"

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: where half of the presses work, if that was searched, else the farthest that worked."""
        if self.was_searched:
            return super().distances
        return (MeasuredDistance(PRESS, self.status, self.distance_m, self.uncertainty_m, is_place=True,
                                 failed_m=self.failed_distance_m),)
