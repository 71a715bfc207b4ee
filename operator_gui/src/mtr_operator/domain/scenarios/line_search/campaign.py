"""What the lines of a test say together: their attempts as evidence, and their results as columns.

The attempts stand in the results, so that a test that goes on after an interruption knows what it knew before.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Iterator, Sequence, TypeVar

from ...estimation.press.campaign import Campaign
from ...estimation.press.hypotheses import Hypotheses
from ...estimation.press.plan import SearchPlan
from ...estimation.press.radial_estimate import RadialEstimate, Reach, estimate
from ...estimation.press.radial_search import RadialSearch
from ...results.line_result import LineStatus
from .result import SearchedResult

Searched = TypeVar("Searched", bound=SearchedResult)

# Decimals of files; a tenth of a millimetre is shown.
DIGITS = 6
_STATUS = {Reach.MEASURED: LineStatus.OK, Reach.NEARER: LineStatus.NOT_REACHED, Reach.FARTHER: LineStatus.NOT_REACHED,
           Reach.NO_ANSWER: LineStatus.INVALID}


class LineCampaign:
    """Lines of one test.

    Attributes:
        plan: what is wanted of each.
    """

    def __init__(self, plan: SearchPlan):
        self.plan = plan
        self._grid: Hypotheses = plan.hypotheses()
        self._campaign = Campaign(self._grid)

    def search(self, number: int) -> RadialSearch:
        """Of one more line, with the key at its start."""
        return RadialSearch(self.plan, self._grid, self._campaign, number, self.plan.maximum_m)

    def recall(self, results: Sequence[Searched]) -> Iterator[tuple[Searched, RadialSearch]]:
        """Take the attempts of earlier lines, one line at a step, for each takes some hundredths of a second."""
        for result in results:
            if result.was_searched and result.status is not LineStatus.INVALID:
                search = self.search(result.number)
                search.recall(result.attempts_made)
                yield result, search


def concluded(plan: SearchPlan, results: Sequence[Searched]) -> list[Searched]:
    """Results that read otherwise with what the lines after them say."""
    campaign = LineCampaign(plan)
    searches = list(campaign.recall(results))
    found = [(result, with_estimate(plan, result, estimate(plan, search))) for result, search in searches]
    return [new for result, new in found if new != result]


def with_estimate(plan: SearchPlan, result: Searched, found: RadialEstimate) -> Searched:
    """The result with the columns of a search; the places of the attempts may be wrong together."""
    sigma_m = math.nan if result.place_sigma_m is None else result.place_sigma_m
    columns = {"status": _STATUS[found.reach], "reach": found.reach.value, **_distances(plan, found, sigma_m),
               "nearest_failure_m": _known(found.nearest_failure_m), "lapse": _known(found.lapse),
               "holes_m": " ".join(f"{hole_m:.2f}" for hole_m in found.holes_m), "fit_quality": _known(found.quality)}
    # The derived classes are dataclasses.
    changed: Searched = replace(result, **columns)  # type: ignore[type-var]
    return changed


def _distances(plan: SearchPlan, found: RadialEstimate, sigma_m: float) -> dict[str, Any]:
    """Only what the attempts support: no distance beyond the places, and no end of an interval there."""
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
    return None if value is None or not math.isfinite(value) else round(value, DIGITS)
