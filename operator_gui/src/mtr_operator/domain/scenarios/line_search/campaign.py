"""What the lines of a test say together: their attempts as evidence, and their results as columns.

The attempts stand in the results, so that a test that goes on after an interruption knows what it knew before.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Generator, Iterator, Sequence, TypeVar, cast

from ...estimation.interval import SIGMAS_OF_LEVEL, Interval
from ...estimation.looks import deviate
from ...estimation.press.campaign import Campaign
from ...estimation.press.hypotheses import Hypotheses
from ...estimation.press.one_boundary import Uneven
from ...estimation.press.plan import SearchPlan
from ...estimation.press.radial_estimate import RadialEstimate, Reach, estimate, estimate_at_look
from ...estimation.press.radial_search import RadialSearch
from ...results.line_result import LineStatus
from .result import SEVERAL_BOUNDARIES, SearchedResult

Searched = TypeVar("Searched", bound=SearchedResult)
Found = TypeVar("Found")

# Decimals of files; a tenth of a millimetre is shown.
DIGITS = 6
_STATUS = {Reach.MEASURED: LineStatus.OK, Reach.NEARER: LineStatus.NOT_REACHED, Reach.FARTHER: LineStatus.NOT_REACHED,
           Reach.NO_ANSWER: LineStatus.INVALID}


class LineCampaign:
    """Lines of one test.

    Attributes:
        plan: what is wanted of each by the parameters; a line that was measured further keeps what was wanted of it.
    """

    def __init__(self, plan: SearchPlan):
        self.plan = plan
        self._grids: dict[float, Hypotheses] = {plan.interval_m: plan.hypotheses()}
        self._campaign = Campaign(self._grids[plan.interval_m], plan.are_near)

    def search(self, number: int, plan: SearchPlan | None = None) -> RadialSearch:
        """Of one more line, with the key at its start; by a plan of its own that differs in what is wanted."""
        plan = plan or self.plan
        grid = self._grids.setdefault(plan.interval_m, plan.hypotheses())
        return RadialSearch(plan, grid, self._campaign, number, plan.maximum_m)

    def recall(self, results: Sequence[Searched]) -> Iterator[tuple[Searched, RadialSearch]]:
        """Take the attempts of earlier lines, one line at a step, for each takes some hundredths of a second."""
        for result in results:
            if result.was_searched and result.status is not LineStatus.INVALID:
                search = self.search(result.number, plan_of(self.plan, result))
                search.recall(result.attempts_made)
                yield result, search


def plan_of(plan: SearchPlan, result: SearchedResult) -> SearchPlan:
    """The plan by which a line was measured last."""
    wanted_m = result.wanted_interval_m
    return plan if wanted_m is None else replace(plan, interval_m=wanted_m)


def concluded(plan: SearchPlan, results: Sequence[Searched]) -> list[Searched]:
    """Results that read otherwise with what the lines after them say."""
    campaign = LineCampaign(plan)
    searches = list(campaign.recall(results))
    found = [(result, finished(_estimated(plan, result, search))) for result, search in searches]
    return [new for result, new in found if new != result]


def looked(plan: SearchPlan, results: Sequence[Searched], number: int) -> Generator[None, None, Searched]:
    """A line with its intervals at the level of its last look; a part of the work with each step."""
    campaign, wanted = LineCampaign(plan), next(result for result in results if result.number == number)
    own = None
    for result, search in campaign.recall(results):
        own = search if result.number == number else own
        yield
    return wanted if own is None else (yield from _estimated(plan, wanted, own))


def finished(steps: Generator[None, None, Found]) -> Found:
    """What a work in parts comes to, all parts at once."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return cast(Found, end.value)


def _estimated(plan: SearchPlan, result: Searched, search: RadialSearch) -> Generator[None, None, Searched]:
    if not result.looks:
        return with_estimate(plan, result, estimate(plan, search))
    return with_estimate(plan, result, (yield from estimate_at_look(plan, search, deviate(result.looks))))


def with_estimate(plan: SearchPlan, result: Searched, found: RadialEstimate) -> Searched:
    """The result with the columns of a search; the places of the attempts may be wrong together."""
    sigma_m = math.nan if result.place_sigma_m is None else result.place_sigma_m
    columns = {"status": _STATUS[found.reach], "reach": found.reach.value, **_distances(plan, found, sigma_m),
               "nearest_failure_m": _known(found.nearest_failure_m), "lapse": _known(found.lapse),
               "holes_m": " ".join(f"{hole_m:.2f}" for hole_m in found.holes_m), "fit_quality": _known(found.quality),
               **_hole(found.uneven),
               **_at_look(plan, found, sigma_m, deviate(result.looks))}
    # The derived classes are dataclasses.
    changed: Searched = replace(result, **columns)  # type: ignore[type-var]
    return changed


def _distances(plan: SearchPlan, found: RadialEstimate, sigma_m: float) -> dict[str, Any]:
    """Only what the attempts support: no distance beyond the places, and no end of an interval there."""
    is_measured = found.reach is Reach.MEASURED
    values: dict[str, Any] = {"d50_sigma_m": _known(found.d50.widened(sigma_m).sigma_m) if is_measured else None}
    for name, interval in (("d50", found.d50), ("d95", found.d95)):
        is_within = is_measured and plan.minimum_m <= interval.value_m and (name == "d50" or found.uneven is None)
        values.update({f"{name}_m": _known(interval.value_m) if is_within else None,
                       **_ends(plan, found, interval, name, (sigma_m, SIGMAS_OF_LEVEL))})
    return values


def _at_look(plan: SearchPlan, found: RadialEstimate, sigma_m: float, sigmas: float) -> dict[str, float | None]:
    """Ends of the intervals that reach so many sigmas."""
    names = ("d50_look", "d95_look")
    if found.look is None:
        return {f"{name}_{end}_m": None for name in names for end in ("low", "high")}
    return {column: end_m for name, interval in zip(names, found.look)
            for column, end_m in _ends(plan, found, interval, name, (sigma_m, sigmas)).items()}


def _ends(plan: SearchPlan, found: RadialEstimate, interval: Interval, name: str,
          place: tuple[float, float]) -> dict[str, float | None]:
    """place: 1 sigma in m of the key's places, and how many of them the interval reaches."""
    uneven = found.uneven_look if name.endswith("look") else found.uneven
    if uneven is not None:
        interval = _without_curve(plan, interval, uneven, name.startswith("d95"))
    wide = interval.widened(*place)
    has_low = interval.low_m >= plan.minimum_m and found.reach is not Reach.NEARER
    has_high = interval.high_m <= plan.maximum_m and found.reach is not Reach.FARTHER
    return {f"{name}_low_m": _known(wide.low_m) if has_low else None,
            f"{name}_high_m": _known(wide.high_m) if has_high else None}


def _without_curve(plan: SearchPlan, interval: Interval, uneven: Uneven, is_sure: bool) -> Interval:
    """From the nearest boundary to the farthest, open at an end of the places; where 95 % work no curve tells."""
    is_open = is_sure or uneven.low_m <= plan.minimum_m
    return replace(interval, low_m=-math.inf if is_open else min(interval.low_m, uneven.low_m),
                   high_m=max(interval.high_m, math.inf if uneven.high_m >= plan.maximum_m else uneven.high_m))


def _hole(uneven: Uneven | None) -> dict[str, Any]:
    """Columns of a line that no falling curve describes."""
    from_m, to_m = (None, None) if uneven is None or uneven.hole_m is None else uneven.hole_m
    return {"boundaries": "" if uneven is None else SEVERAL_BOUNDARIES, "hole_from_m": _known(from_m),
            "hole_to_m": _known(to_m)}


def _known(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else round(value, DIGITS)
