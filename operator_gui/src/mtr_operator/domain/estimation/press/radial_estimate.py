"""Result of a radial: distances with intervals, the farthest success, the nearest failure, and doubts.

Fit quality: the presses' surprise S = -sum ln P(y) relative to its expectation and spread on the median curve,

    z = (S - sum H(p)) / sqrt(sum p (1-p) ln^2(p / (1-p))),   quality = 1 - Phi(z):

the share of radials on such a curve that would fit worse. Near 0 the curve does not describe the radial.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
import statistics
from dataclasses import dataclass, replace
from typing import Generator, Sequence

import numpy as np
from scipy.special import bdtrc, ndtr

from ..interval import Interval, interval_of_draws
from .likelihood import Press
from .one_boundary import Uneven
from .plan import SearchPlan
from .posterior import RadialPosterior
from .radial_search import PRESSES_IN_DOUBT, SURE_TO_WORK, RadialSearch
from .transition import falling

# A place is a hole if its number of failures has a smaller probability than this on the curve.
_RARE = 0.005


class Reach(enum.Enum):
    """Most probable location of the boundary."""

    MEASURED = "measured"
    NEARER = "nearer"  # than the nearest place: only an upper bound is known
    FARTHER = "farther"  # than the farthest place: only a lower bound is known
    NO_ANSWER = "no_answer"  # nowhere: does the key sleep, or is its battery empty?


@dataclass(frozen=True)
class RadialEstimate:
    """Estimate of one radial; distances in m.

    Attributes:
        d50, d95: of this line, see line_boundary.
        farthest_success_m, nearest_failure_m: of the presses so far; None without one.
        holes_m: places inside with repeated failures, although farther ones worked.
        lapse: share of presses that fail at any distance.
        quality: share of radials on the estimated curve that would fit worse.
        uneven: set if one falling curve does not describe the radial; d50 is of the curve that fits best. look: d50 and
        d95 with the intervals of the last look at the line; None without.
    """

    reach: Reach
    d50: Interval
    d95: Interval
    farthest_success_m: float | None
    nearest_failure_m: float | None
    presses: int
    holes_m: tuple[float, ...]
    lapse: float
    quality: float
    look: tuple[Interval, Interval] | None = None
    uneven: Uneven | None = None
    uneven_look: Uneven | None = None


def estimate(plan: SearchPlan, search: RadialSearch) -> RadialEstimate:
    """Estimate with the current state of the other radials."""
    search.revisit()
    boundary = search.boundary()
    return _estimated(plan, search, boundary.d50(), boundary.d95())


def estimate_at_look(plan: SearchPlan, search: RadialSearch, sigmas: float) -> Generator[None, None, RadialEstimate]:
    """Estimate with additional intervals of this many sigmas; each step of the generator does a part of the work."""
    search.revisit()
    d50_m, d95_m = [], []
    tail = float(ndtr(-sigmas))
    for boundary in search.boundaries(tail):
        d50_m.append(boundary.d50_m)
        d95_m.append(boundary.d95_m)
        yield
    draws_m = np.concatenate(d50_m), np.concatenate(d95_m)
    d50_look, d95_look = (interval_of_draws(each_m, 1.0 - 2.0 * tail) for each_m in draws_m)
    return replace(_estimated(plan, search, *map(interval_of_draws, draws_m)), look=(d50_look, d95_look),
                   uneven_look=search.uneven(sigmas))


def _estimated(plan: SearchPlan, search: RadialSearch, d50: Interval, d95: Interval) -> RadialEstimate:
    posterior, presses = search.posterior(), search.presses
    worked = [press.distance_m for press in presses if press.worked]
    failed = [press.distance_m for press in presses if not press.worked]
    return RadialEstimate(_reach(plan, d50, presses), d50, d95, max(worked, default=None),
                          min(failed, default=None), len(presses), _holes(search), posterior.lapse,
                          _quality(posterior, presses), uneven=search.uneven())


def answers_nowhere(plan: SearchPlan, presses: Sequence[Press]) -> bool:
    """Return True if no press worked, including repeated ones at the nearest place; the cause is unknown."""
    at_nearest = sum(press.distance_m <= plan.minimum_m + plan.half_wavelength_m / 2.0 for press in presses)
    return not any(press.worked for press in presses) and at_nearest >= PRESSES_IN_DOUBT


def _reach(plan: SearchPlan, d50: Interval, presses: Sequence[Press]) -> Reach:
    if answers_nowhere(plan, presses):
        return Reach.NO_ANSWER
    if not d50.value_m > plan.minimum_m:
        return Reach.NEARER
    return Reach.MEASURED if d50.value_m < plan.maximum_m else Reach.FARTHER


def _curve(posterior: RadialPosterior, distance_m: float) -> float:
    """Return the probability that a press works on the median curve."""
    width_m = math.exp(float(posterior.widths() @ np.log(posterior.hypotheses.width_m)))
    return (1.0 - posterior.lapse) * float(falling(distance_m, posterior.d50().value_m, width_m))


def _holes(search: RadialSearch) -> tuple[float, ...]:
    """Return places with more failures than the other presses allow.

    A place within the interval that d50 has without it is excluded: failures there may be the boundary itself.
    """
    presses, found = search.presses, []
    farthest_m = max((press.distance_m for press in presses if press.worked), default=0.0)
    inside = [press for press in presses if press.distance_m < farthest_m]
    for place in sorted({search.place_of(press.distance_m) for press in inside}):
        beside = [press for press in inside if search.place_of(press.distance_m) == place]
        here = [press.worked for press in beside]
        distance_m = statistics.fmean(press.distance_m for press in beside)
        failures = here.count(False)
        if failures >= 2 and _is_rare(search.posterior_without(distance_m), distance_m, failures, len(here)):
            found.append(distance_m)
    return tuple(found)


def _is_rare(posterior: RadialPosterior, distance_m: float, failures: int, count: int) -> bool:
    """Return True for a place before the boundary whose number of failures is rare over all possible curves."""
    grid = posterior.hypotheses
    works = (1.0 - posterior.lapse) * falling(distance_m, grid.d50_m, grid.width_m[:, None])
    tail = bdtrc(failures - 1, count, 1.0 - np.minimum(works, SURE_TO_WORK))
    return distance_m < posterior.d50().low_m and float(np.sum(posterior.by_width * tail)) < _RARE


def _quality(posterior: RadialPosterior, presses: Sequence[Press]) -> float:
    works = np.clip([_curve(posterior, press.distance_m) for press in presses], 1e-9, 1.0 - 1e-9)
    worked = np.array([press.worked for press in presses])
    surprise = -np.sum(np.log(np.where(worked, works, 1.0 - works)))
    expected = -np.sum(works * np.log(works) + (1.0 - works) * np.log(1.0 - works))
    spread = math.sqrt(float(np.sum(works * (1.0 - works) * np.log(works / (1.0 - works)) ** 2)))
    return float(1.0 - ndtr((surprise - expected) / spread)) if spread > 0.0 else math.nan
