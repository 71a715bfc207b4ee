"""What the results of all lines that are measured by search have in common."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from dataclasses import replace
from typing import Any, ClassVar

from ... import limits
from ...estimation.press.likelihood import Press
from ...estimation.press.radial_estimate import Reach
from ...results.document import Floats, OptionalFloat
from ...results.line_result import (
    BOUNDARY_PERCENT,
    Ends,
    LineResult,
    LineStatus,
    Looked,
    MeasuredDistance,
    boundary,
    column,
)

# Shares of the attempts for whose distances there are intervals; the last is that at d95.
SHARES = (5, 50, 95)
SURE_PERCENT = SHARES[-1]
REACHES = ("", *(reach.value for reach in Reach))
# Half of an interval that a search may aim at; it divides the range into a grid.
_WANTED = limits.Limit("half of the interval wanted", 0.01, 10.0, "m")
# Of SearchedResult.boundaries.
SEVERAL_BOUNDARIES = "several"
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
# Far beyond any attempts_limit.
_MAX_ATTEMPTS = 1000


class SearchColumns:
    """Fields of what every search finds, in the scenario's words: "requests", "axes"; one of these for each dataclass.

    Where in the file they stand is the dataclass' own order, so that it names them.
    """

    def __init__(self, attempts: str, lines: str):
        d50, d95 = (f"distance at which {share} of the {attempts} work" for share in ("half", "95 %"))
        d95 += ", lapses apart"
        self.d50_m = _distance(d50)
        self.d50_sigma_m = _distance(f"1 sigma of the {d50}")
        self.d50_low_m, self.d50_high_m = _ends_of(d50)
        self.d95_m = _distance(d95)
        self.d95_low_m, self.d95_high_m = _ends_of(d95)
        self.lapse = column(f"share of {attempts} that fail at any distance", default=None)
        self.fit_quality = column(f"share of {lines} on the curve found that would fit worse; below 0.02 the curve "
                                  "does not describe this one", default=None)
        self.unconfirmed_m = column(f"places of {attempts} that worked against all expectation, and not again: not "
                                    "counted", "m", default="")


class SearchedResult(Looked, LineResult):
    """What a search finds; a scenario's dataclass declares each, those of SearchColumns and three with its own words.

    Attributes:
        WORD: what the distance is called, of the scenario's distance_words.
        reach: see Reach; empty when nothing was searched.
        d50_m, d95_m: distances at which 50 and 95 % of the attempts work; None beyond the places.
        holes_m: places that failed again and again although farther ones worked, "3.10 4.20".
        unconfirmed_m: places of attempts that worked against all expectation, and not again; likewise.
        worked_at_m, failed_at_m: of all attempts that count.
        place_sigma_m: largest 1 sigma of these places.
        wanted_interval_m: half the width of the interval for which the line was measured last, with whose grid it is
            estimated; None for that of the parameters.
        boundaries: "several" where one falling curve does not describe the line, so that it has more than one boundary.
        hole_from_m, hole_to_m: extent of the nearest hole of such a line, None where none is seen; hole_from_m alone
            is None where nothing nearer worked.
        d50_look_low_m and so on: ends of the intervals at the level of the last look.
    """

    WORD: ClassVar[str]
    status: LineStatus
    reach: str
    d50_m: OptionalFloat
    d50_sigma_m: OptionalFloat
    d50_low_m: OptionalFloat
    d50_high_m: OptionalFloat
    d95_m: OptionalFloat
    d95_low_m: OptionalFloat
    d95_high_m: OptionalFloat
    holes_m: str
    unconfirmed_m: str
    worked_at_m: Floats
    failed_at_m: Floats
    place_sigma_m: OptionalFloat
    wanted_interval_m: OptionalFloat
    boundaries: str
    hole_from_m: OptionalFloat
    hole_to_m: OptionalFloat
    d50_look_low_m: OptionalFloat
    d50_look_high_m: OptionalFloat
    d95_look_low_m: OptionalFloat
    d95_look_high_m: OptionalFloat

    @property
    def was_searched(self) -> bool:
        """False for a line that was measured in another way."""
        return True

    @property
    def attempts_made(self) -> list[Press]:
        """All of them; their order says nothing."""
        return [*(Press(place_m, True) for place_m in self.worked_at_m),
                *(Press(place_m, False) for place_m in self.failed_at_m)]

    @property
    def is_possible(self) -> bool:
        """See LineResult."""
        places_m = (*self.worked_at_m, *self.failed_at_m)
        return (super().is_possible and self.reach in REACHES and self.boundaries in ("", SEVERAL_BOUNDARIES)
                and len(places_m) <= _MAX_ATTEMPTS
                and all(limits.DISTANCE.allows(place_m) for place_m in places_m)
                and (self.wanted_interval_m is None or _WANTED.allows(self.wanted_interval_m))
                and all(end_m is None or limits.DISTANCE.allows(end_m) for end_m in (self.hole_from_m, self.hole_to_m))
                and (self.place_sigma_m is None or limits.DISTANCE_SIGMA.allows(self.place_sigma_m)))

    @property
    def findings(self) -> tuple[str, ...]:
        """See LineResult."""
        if not self.boundaries:
            return ()
        if self.hole_to_m is None:
            return ("more than one boundary; the interval reaches from the nearest to the farthest",)
        where = "up to" if self.hole_from_m is None else f"from {self.hole_from_m:.2f} to"
        return (f"more than one boundary, a hole {where} {self.hole_to_m:.2f} m; the interval reaches from the nearest "
                "boundary to the farthest",)

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: where half of the attempts work."""
        half = boundary(self.WORD, self.status, self.d50_m, self.d50_sigma_m, (self.d50_low_m, self.d50_high_m))
        return (replace(half, look_m=self._look(self.d50_look_low_m, self.d50_look_high_m)),)

    def distances_at(self, share_percent: int) -> tuple[MeasuredDistance, ...]:
        """See LineResult. The curve is symmetrical: 5 % work as far beyond d50 as 95 % do nearer than it; the ends of
        that interval are the safe ones, for how the errors of d50 and d95 go together is not kept."""
        if not self.was_searched or share_percent == BOUNDARY_PERCENT or share_percent not in SHARES:
            return super().distances_at(share_percent)
        sure = replace(boundary(self.WORD, self.status, self.d95_m, None, (self.d95_low_m, self.d95_high_m)),
                       look_m=self._look(self.d95_look_low_m, self.d95_look_high_m))
        if share_percent == SURE_PERCENT:
            return (sure,)
        half = self.distances[0]
        look_m = None if half.look_m is None or sure.look_m is None else _mirrored_ends(half.look_m, sure.look_m)
        rare = boundary(self.WORD, self.status, _mirrored(half.distance_m, sure.distance_m), None,
                        _mirrored_ends((half.low_m, half.high_m), (sure.low_m, sure.high_m)))
        return (replace(rare, look_m=look_m),)

    def _look(self, low_m: OptionalFloat, high_m: OptionalFloat) -> Ends | None:
        return (low_m, high_m) if self.looks else None

    def holes_nearer_than(self, distance_m: float) -> tuple[float, ...]:
        """See LineResult."""
        return tuple(hole_m for hole_m in map(float, _NUMBER.findall(self.holes_m)) if hole_m < distance_m)


def _distance(doc: str) -> Any:
    return column(doc, "m", default=None)


def _ends_of(distance: str) -> tuple[Any, Any]:
    """Of its 95 % interval."""
    low, high = (_distance(f"{end} end of the 95 % interval of the {distance}, empty when it lies beyond the places")
                 for end in ("lower", "upper"))
    return low, high


def _mirrored_ends(half_m: Ends, sure_m: Ends) -> Ends:
    return _mirrored(half_m[0], sure_m[1]), _mirrored(half_m[1], sure_m[0])


def _mirrored(half_m: float | None, sure_m: float | None) -> float | None:
    return None if half_m is None or sure_m is None else 2.0 * half_m - sure_m
