"""What the radials of a Key press test say together: their presses as evidence, and their results as columns.

The presses stand in the results, so that a test that goes on after an interruption knows what it knew before.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Iterator, Sequence

from ...estimation.press.campaign import Campaign
from ...estimation.press.hypotheses import Hypotheses
from ...estimation.press.likelihood import Press
from ...estimation.press.plan import SearchPlan
from ...estimation.press.radial_estimate import RadialEstimate, Reach, estimate
from ...estimation.press.radial_search import RadialSearch
from ...results.line_result import LineStatus
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import ADAPTIVE, KeyPressResult

# Decimals of files; a tenth of a millimetre is shown.
_DIGITS = 6
_STATUS = {Reach.MEASURED: LineStatus.OK, Reach.NEARER: LineStatus.NOT_REACHED, Reach.FARTHER: LineStatus.NOT_REACHED,
           Reach.NO_ANSWER: LineStatus.INVALID}


class PressCampaign:
    """Radials of one test.

    Attributes:
        plan: what is wanted of each.
    """

    def __init__(self, plan: SearchPlan):
        self.plan = plan
        self._grid: Hypotheses = plan.hypotheses()
        self._campaign = Campaign(self._grid)

    def search(self, radial: int) -> RadialSearch:
        """Of one more radial, with the key at its start."""
        return RadialSearch(self.plan, self._grid, self._campaign, radial, self.plan.maximum_m)

    def recall(self, results: Sequence[KeyPressResult]) -> Iterator[tuple[KeyPressResult, RadialSearch]]:
        """Take the presses of earlier radials, one at a step, for each takes some hundredths of a second."""
        for result in results:
            if result.method == ADAPTIVE and result.status is not LineStatus.INVALID:
                search = self.search(result.radial)
                search.recall(presses_of(result))
                yield result, search


def presses_of(result: KeyPressResult) -> list[Press]:
    """All presses of a radial; their order says nothing."""
    return [*(Press(place_m, True) for place_m in result.worked_at_m),
            *(Press(place_m, False) for place_m in result.failed_at_m)]


def concluded(parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> list[KeyPressResult]:
    """Results that read otherwise with what the radials after them say."""
    campaign = PressCampaign(parameters.search_plan)
    searches = list(campaign.recall(results))
    found = [(result, with_estimate(campaign.plan, result, estimate(campaign.plan, search)))
             for result, search in searches]
    return [new for result, new in found if new != result]


def with_estimate(plan: SearchPlan, result: KeyPressResult, found: RadialEstimate) -> KeyPressResult:
    """The result with its columns of the method adaptive; the places of the presses may be wrong together."""
    sigma_m = math.nan if result.place_sigma_m is None else result.place_sigma_m
    return replace(result, status=_STATUS[found.reach], reach=found.reach.value, **_distances(plan, found, sigma_m),
                   nearest_failure_m=_known(found.nearest_failure_m), lapse=_known(found.lapse),
                   holes_m=" ".join(f"{hole_m:.2f}" for hole_m in found.holes_m), fit_quality=_known(found.quality))


def _distances(plan: SearchPlan, found: RadialEstimate, sigma_m: float) -> dict[str, Any]:
    """Only what the presses support: no distance beyond the places, and no end of an interval there."""
    is_measured = found.reach is Reach.MEASURED
    values: dict[str, Any] = {"d50_sigma_m": _known(found.d50.widened(sigma_m).sigma_m) if is_measured else None}
    for name, interval in (("d50", found.d50), ("d95", found.d95)):
        wide = interval.widened(sigma_m)
        has_low = interval.low_m >= plan.minimum_m and found.reach is not Reach.NEARER
        has_high = interval.high_m <= plan.maximum_m and found.reach is not Reach.FARTHER
        is_within = is_measured and plan.minimum_m <= interval.value_m
        values.update({f"{name}_m": _known(interval.value_m) if is_within else None,
                       f"{name}_low_m": _known(wide.low_m) if has_low else None,
                       f"{name}_high_m": _known(wide.high_m) if has_high else None})
    return values


def _known(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else round(value, _DIGITS)
