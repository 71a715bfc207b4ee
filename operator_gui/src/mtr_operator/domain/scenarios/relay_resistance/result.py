"""What Relay resistance records of one axis."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

from ...actions.distance import Distance, recorded_values
from ...results.carried import CAUSE_DOC, DOORS_DOC, HEADING_DOC, KEY_NUMBER_DOC, LATERAL_DOC, carried_values
from ...results.document import Floats, OptionalFloat, OptionalInt, Texts
from ...results.line_result import LineResult, LineStatus, MeasuredDistance, OnAxis, column, stored
from ...results.quantity import MeasuredQuantity
from .tally import Resistance, Tried, lower_bound, resistance_of, tally_columns, upper_bound

RELAY, RELAY_PROBABILITY = "relay", "relay_probability"
_PERCENT = 100.0
# Columns of the farthest unlock, as they are without one.
_OF_FARTHEST: dict[str, Any] = {"lateral_offset_m": None, "heading_offset_deg": None, "cause": "", "key_number": None,
                                "doors": ""}
# Far beyond 8 places times requests_per_place.
_MAX_REQUESTS = 10_000
_ROUNDING = 1e-5


@dataclass(frozen=True)
class RelayResistanceResult(OnAxis, LineResult):
    """Distances are those of the Remote key from the Car's side or corner, along the axis; off, on: the extender's
    state. All requests are beyond the nominal border."""

    axis: int = column("number of the axis, clockwise from the front side's left end")
    side: str = column("side or corner of the Car")
    key_height_m: float = column("height of the Remote key above ground", "m")
    status: LineStatus = column("ok: unlocked with the extender on; not_reached: never; or invalid")
    resistance: str = column("not_resistant: unlocked with the extender on; bounded: never, which bounds the "
                             "probability by bound_on", default="")
    border_m: OptionalFloat = column("nominal border of the zone", "m", default=None)
    requests_off: int = column("handle requests with the extender off", default=0)
    unlocks_off: int = column("those of them at which the Car unlocked: the zone reaches farther than its nominal "
                              "border", default=0)
    bound_off: OptionalFloat = column("one-sided 95 % upper bound of the probability that one of these unlocks", "", 4,
                                      None)
    requests_on: int = column("handle requests with the extender on", default=0)
    unlocks_on: int = column("those of them at which the Car unlocked", default=0)
    bound_on: OptionalFloat = column("one-sided 95 % upper bound of the probability that one of these unlocks", "", 4,
                                     None)
    unlocked_off_m: Floats = column("places of the unlocks with the extender off", "m", 3, ())
    silent_off_m: Floats = column("places of the other requests with the extender off", "m", 3, ())
    unlocked_on_m: Floats = column("places of the unlocks with the extender on", "m", 3, ())
    silent_on_m: Floats = column("places of the other requests with the extender on", "m", 3, ())
    requested_by: str = column("who took the handle: output or operator", default="")
    switched_by: str = column("who switched the extender: output or operator", default="")
    distance_m: OptionalFloat = column("Remote key from the Car's side or corner at the farthest unlock with the "
                                       "extender on", "m", default=None)
    uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m", default=None)
    robot_time_s: OptionalFloat = column("robot's clock at that request", "s", 3, None)
    lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} at that request", "m", default=None)
    heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} at that request", "deg", 2, None)
    cause: str = column(f"what unlocked the Car: {CAUSE_DOC}", default="")
    key_number: OptionalInt = column(f"of cause: {KEY_NUMBER_DOC}", default=None)
    doors: str = column(f"of that request: {DOORS_DOC}", default="")
    reason: str = stored("")
    evidence: Texts = stored(())

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: the farthest unlock with the extender on. A silence farther away is no end of the range: it
        bounds a probability, and no distance."""
        return (MeasuredDistance(RELAY, self.status, self.distance_m, self.uncertainty_m),)

    @property
    def quantities(self) -> tuple[MeasuredQuantity, ...]:
        """See LineResult: in percent, with the extender on; each end holds in 95 % by itself."""
        if self.status is LineStatus.INVALID or self.bound_on is None:
            return (MeasuredQuantity(RELAY_PROBABILITY, None, None),)
        low = lower_bound(self.unlocks_on, self.requests_on)
        return (MeasuredQuantity(RELAY_PROBABILITY, _PERCENT * low, _PERCENT * self.bound_on),)

    @property
    def findings(self) -> tuple[str, ...]:
        """See LineResult. The word resistant never stands alone: requests only bound how often the Car unlocks."""
        if self.status is LineStatus.INVALID:
            return ()
        return (self._finding_on, *((self._finding_off,) if self.unlocks_off else ()))

    @property
    def _finding_on(self) -> str:
        counts = f"with the extender {self.unlocks_on} of {self.requests_on} unlocked"
        if self.unlocks_on:
            return f"not resistant: {counts}, up to {max(self.unlocked_on_m):.2f} m"
        return f"resistant but for at most {100.0 * (self.bound_on or 1.0):.1f} % (95 %): {counts}"

    @property
    def _finding_off(self) -> str:
        return (f"zone beyond its border: without the extender {self.unlocks_off} of {self.requests_off} unlocked, "
                f"up to {max(self.unlocked_off_m):.2f} m")

    @property
    def is_possible(self) -> bool:
        """See LineResult: the verdict is that of the requests, and none is from within the border."""
        of_state = ((self.unlocked_off_m, self.silent_off_m, self.unlocks_off, self.requests_off, self.bound_off),
                    (self.unlocked_on_m, self.silent_on_m, self.unlocks_on, self.requests_on, self.bound_on))
        if not all(_fits(*each) for each in of_state):
            return False
        if self.status is LineStatus.INVALID:
            return self.resistance == ""
        if self.border_m is None or not self.requests_off or not self.requests_on:
            return False
        border_m, places_m = self.border_m, (*of_state[0][0], *of_state[0][1], *of_state[1][0], *of_state[1][1])
        return (all(place_m > border_m for place_m in places_m)
                and self.resistance == resistance_of(self.unlocks_on).value
                and (self.status is LineStatus.OK) is (self.resistance == Resistance.NOT_RESISTANT.value))


def _fits(unlocked_m: Floats, silent_m: Floats, unlocks: int, requests: int, bound: OptionalFloat) -> bool:
    """The counts are those of the places, and the bound is that of the counts."""
    if (len(unlocked_m), len(unlocked_m) + len(silent_m)) != (unlocks, requests) or requests > _MAX_REQUESTS:
        return False
    if bound is None or not requests:
        return bound is None and not requests
    return math.isclose(bound, upper_bound(unlocks, requests), abs_tol=_ROUNDING)


def valid_columns(tried: Sequence[Tried], farthest: Distance | None) -> dict[str, Any]:
    """Columns of a valid axis that follow from its requests; farthest: unlock with the extender on, None if none."""
    distance_m, uncertainty_m, robot_time_s = recorded_values(farthest)
    carried = {name: value for name, value in carried_values("", farthest).items() if name in _OF_FARTHEST}
    return {**tally_columns(tried), **_OF_FARTHEST, **carried, "distance_m": distance_m,
            "uncertainty_m": uncertainty_m, "robot_time_s": robot_time_s,
            "status": LineStatus.NOT_REACHED if farthest is None else LineStatus.OK,
            "resistance": resistance_of(int(farthest is not None)).value}
