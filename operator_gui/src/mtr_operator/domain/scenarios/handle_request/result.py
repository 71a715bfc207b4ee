"""What Handle request records of one axis."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...results.carried import CAUSE_DOC, DOORS_DOC, HEADING_DOC, KEY_NUMBER_DOC, LATERAL_DOC
from ...results.document import Floats, OptionalFloat, OptionalInt, Texts
from ...results.line_result import LineStatus, OnAxis, column, stored
from ..line_search.result import SearchColumns, SearchedResult

HANDLE_WORD = "handle"
_SEARCH = SearchColumns("requests", "axes")


@dataclass(frozen=True)
class HandleRequestResult(OnAxis, SearchedResult):
    """Distances are those of the Remote key from the Car's side or corner, along the axis. inside: the Car unlocked;
    outside: it did not."""

    WORD = HANDLE_WORD

    axis: int = column("number of the axis, clockwise from the front side's left end, then the next height")
    side: str = column("side or corner of the Car")
    key_height_m: float = column("height of the Remote key above ground", "m")
    status: LineStatus = column("ok, not_reached or invalid")
    requests: int = column("handle requests on this axis")
    inside: int = column("requests at which the Car unlocked, those not counted in the border included")
    outside: int = column("requests at which it did not")
    border_m: OptionalFloat = column("nominal border, empty if no requests were wanted there", "m", default=None)
    inside_at_border: int = column("requests at the nominal border at which the Car unlocked", default=0)
    outside_at_border: int = column("requests at the nominal border at which it did not", default=0)
    requested_by: str = column("who took the handle: output or operator", default="")
    distance_m: OptionalFloat = column("Remote key from the Car's side or corner at the farthest request inside", "m",
                                       default=None)
    uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m", default=None)
    robot_time_s: OptionalFloat = column("robot's clock at that request", "s", 3, None)
    lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} at that request", "m", default=None)
    heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} at that request", "deg", 2, None)
    cause: str = column(f"what unlocked the Car: {CAUSE_DOC}", default="")
    reach: str = column("where the border lies: measured; nearer than the nearest place; farther than the farthest "
                        "one; no_answer: nobody knows", default="")
    d50_m: OptionalFloat = _SEARCH.d50_m
    d50_sigma_m: OptionalFloat = _SEARCH.d50_sigma_m
    d50_low_m: OptionalFloat = _SEARCH.d50_low_m
    d50_high_m: OptionalFloat = _SEARCH.d50_high_m
    d95_m: OptionalFloat = _SEARCH.d95_m
    d95_low_m: OptionalFloat = _SEARCH.d95_low_m
    d95_high_m: OptionalFloat = _SEARCH.d95_high_m
    nearest_failure_m: OptionalFloat = column("nearest request outside", "m", default=None)
    holes_m: str = column("places that were outside again and again although farther ones were inside", default="")
    lapse: OptionalFloat = _SEARCH.lapse
    fit_quality: OptionalFloat = _SEARCH.fit_quality
    unconfirmed_m: str = _SEARCH.unconfirmed_m
    origin_x_m: OptionalFloat = column("origin of the axis, Car coordinate system", "m", default=None)
    origin_y_m: OptionalFloat = column("origin of the axis, Car coordinate system", "m", default=None)
    direction_x: OptionalFloat = column("unit vector of the axis away from the Car", "", 6, None)
    direction_y: OptionalFloat = column("unit vector of the axis away from the Car", "", 6, None)
    key_number: OptionalInt = column(f"of cause: {KEY_NUMBER_DOC}", default=None)
    doors: str = column(f"of that request: {DOORS_DOC}", default="")
    reason: str = stored("")
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
    def is_possible(self) -> bool:
        """See LineResult."""
        inside, outside = len(self.worked_at_m) + len(self.unconfirmed_m.split()), len(self.failed_at_m)
        counts = (inside, outside, inside + outside)
        at_border = (self.inside_at_border, self.outside_at_border)
        return (super().is_possible and counts == (self.inside, self.outside, self.requests)
                and all(0 <= part <= whole for part, whole in zip(at_border, counts)))
