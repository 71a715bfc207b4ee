"""What Key press records of one radial."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from dataclasses import dataclass

from .. import limits
from ..estimation.press.radial_estimate import Reach
from ..results.carried import CAUSE_DOC, HEADING_DOC, HEIGHT_DOC, LATERAL_DOC, SPEED_DOC
from ..results.document import Floats, OptionalFloat, Texts
from ..results.line_result import BOUNDARY_PERCENT, LineResult, LineStatus, MeasuredDistance, column, stored

PRESS = "press"
# Of another press at the place of one that worked.
CONFIRMING = "confirming press"
# Share of the presses at d95.
SURE_PERCENT = 95
SCAN, ADAPTIVE = "scan", "adaptive"
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_REACHES = ("", *(reach.value for reach in Reach))
# Far beyond any attempts_limit.
_MAX_PRESSES = 1000
_OF_D50 = "distance at which half of the presses work"
_OF_D95 = "distance at which 95 % of the presses work, lapses apart"
_BEYOND = ", empty when it lies beyond the places"
_LOW, _HIGH = "lower end of the 95 % interval of the", "upper end of the 95 % interval of the"


@dataclass(frozen=True)
class KeyPressResult(LineResult):
    """Distances are those of the Remote key from the Car's centre, along the radial."""

    FILE_ORDER = ("radial", "angle_deg", "status", "distance_m", "uncertainty_m", "robot_time_s", "failed_distance_m",
                  "attempts", "reason", "lateral_offset_m", "heading_offset_deg", "key_height_m", "speed_mps", "cause",
                  "method", "reach", "d50_m", "d50_sigma_m", "d50_low_m", "d50_high_m", "d95_m", "d95_low_m",
                  "d95_high_m", "nearest_failure_m", "holes_m", "lapse", "fit_quality", "unconfirmed_m",
                  "worked_at_m", "failed_at_m", "place_sigma_m", "evidence")

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
    d50_m: OptionalFloat = column(_OF_D50, "m", default=None)
    d50_sigma_m: OptionalFloat = column(f"1 sigma of the {_OF_D50}", "m", default=None)
    d50_low_m: OptionalFloat = column(f"{_LOW} {_OF_D50}{_BEYOND}", "m", default=None)
    d50_high_m: OptionalFloat = column(f"{_HIGH} {_OF_D50}{_BEYOND}", "m", default=None)
    d95_m: OptionalFloat = column(_OF_D95, "m", default=None)
    d95_low_m: OptionalFloat = column(f"{_LOW} {_OF_D95}{_BEYOND}", "m", default=None)
    d95_high_m: OptionalFloat = column(f"{_HIGH} {_OF_D95}{_BEYOND}", "m", default=None)
    nearest_failure_m: OptionalFloat = column("nearest press that failed", "m", default=None)
    holes_m: str = column("places that failed again and again although farther ones worked", "m", default="")
    lapse: OptionalFloat = column("share of presses that fail at any distance", default=None)
    fit_quality: OptionalFloat = column(
        "share of radials on the curve found that would fit worse; below 0.02 the curve does not describe this one",
        default=None)
    unconfirmed_m: str = column("places of presses that worked against all expectation, and not again: not counted",
                                "m", default="")
    worked_at_m: Floats = stored(())
    failed_at_m: Floats = stored(())
    place_sigma_m: OptionalFloat = stored(None)
    evidence: Texts = stored(())

    @property
    def is_possible(self) -> bool:
        """See LineResult."""
        places_m = (*self.worked_at_m, *self.failed_at_m)
        return (self.method in (SCAN, ADAPTIVE) and self.reach in _REACHES and len(places_m) <= _MAX_PRESSES
                and all(limits.DISTANCE.allows(place_m) for place_m in places_m)
                and (self.place_sigma_m is None or limits.DISTANCE_SIGMA.allows(self.place_sigma_m)))

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
        if self.method == ADAPTIVE:
            return (MeasuredDistance(PRESS, self.status, self.d50_m, self.d50_sigma_m, self.d50_low_m,
                                     self.d50_high_m),)
        return (MeasuredDistance(PRESS, self.status, self.distance_m, self.uncertainty_m),)

    def distances_at(self, share_percent: int) -> tuple[MeasuredDistance, ...]:
        """See LineResult. The curve is symmetrical: 5 % work as far beyond d50 as 95 % do nearer than it; the ends of
        that interval are the safe ones, for how the errors of d50 and d95 go together is not kept."""
        if self.method != ADAPTIVE or share_percent == BOUNDARY_PERCENT:
            return super().distances_at(share_percent)
        sure = MeasuredDistance(PRESS, self.status, self.d95_m, None, self.d95_low_m, self.d95_high_m)
        if share_percent == SURE_PERCENT:
            return (sure,)
        half = self.distances[0]
        return (MeasuredDistance(PRESS, self.status, _mirrored(half.distance_m, sure.distance_m), None,
                                 _mirrored(half.low_m, sure.high_m), _mirrored(half.high_m, sure.low_m)),)

    def holes_nearer_than(self, distance_m: float) -> tuple[float, ...]:
        """See LineResult."""
        return tuple(hole_m for hole_m in map(float, _NUMBER.findall(self.holes_m)) if hole_m < distance_m)


def _mirrored(half_m: float | None, sure_m: float | None) -> float | None:
    return None if half_m is None or sure_m is None else 2.0 * half_m - sure_m
