"""Confidence levels of repeated looks at a line, such that all looks together err as rarely as a single one.

An undecided line gets more attempts and is judged again. A 95 % interval at each look would pass and fail wrongly far
more often than 2.5 % each. The error probability is therefore spent over the looks: at the share t of the maximum
number of attempts, ERROR_PER_SIDE * t^2 is spent. The deviate of a look is the boundary that a Brownian motion, not
stopped by an earlier look, exceeds with the probability spent at this look. Its density is computed from look to look
on a grid. If no further attempts follow, the last look spends the rest. A single look has the deviate of a 95 %
interval.

Sources: Lan and DeMets, Biometrika 70 (1983); Jennison and Turnbull, Group Sequential Methods, 2000, chapters 7, 19.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr

from .interval import LEVEL, SIGMAS_OF_LEVEL, FloatArray

# Probability of a wrong pass, and likewise of a wrong fail.
ERROR_PER_SIDE = (1.0 - LEVEL) / 2.0
_POWER = 2.0
# Beyond this many sigmas, one look in 10^9, the posterior is inaccurate.
MAX_DEVIATE = 6.0
# Smaller error probabilities are rounding, and so are smaller differences between the shares of two looks.
_NOTHING = 1e-9
_NODES = 257


@dataclass(frozen=True)
class Look:
    """One look at a line.

    Attributes:
        share: attempts so far relative to the maximum of the line; above 0, at most 1.
        spent: error probability of each side that is spent so far.
    """

    share: float
    spent: float


def with_look(looks: Sequence[Look], share: float) -> tuple[Look, ...]:
    """Append a look with a share of the attempts; without more attempts than before it is the same look."""
    before = looks[-1] if looks else Look(0.0, 0.0)
    share = min(share, 1.0)
    if share <= before.share + _NOTHING:
        return tuple(looks)
    return (*looks, Look(share, max(ERROR_PER_SIDE * share ** _POWER, before.spent)))


def last_look(looks: Sequence[Look]) -> tuple[Look, ...]:
    """Return the looks if no further attempts follow: the last one spends the rest."""
    return (*looks[:-1], Look(looks[-1].share, ERROR_PER_SIDE)) if looks else ()


def are_possible(looks: Sequence[Look]) -> bool:
    """Return False for invalid looks of a file: each must have more attempts than the previous one."""
    shares, spent = [0.0, *(look.share for look in looks)], [0.0, *(look.spent for look in looks)]
    return (all(later - earlier > _NOTHING for earlier, later in zip(shares, shares[1:])) and shares[-1] <= 1.0
            and sorted(spent) == spent and spent[-1] <= ERROR_PER_SIDE + _NOTHING)


def is_spent(looks: Sequence[Look]) -> bool:
    """Return True if another look could not decide anything."""
    return bool(looks) and looks[-1].spent >= ERROR_PER_SIDE - _NOTHING


def deviate(looks: Sequence[Look]) -> float:
    """Return the deviate in sigmas at which the last look decides; without looks the one of a 95 % interval, infinite
    if earlier looks have spent everything."""
    return _deviate(tuple(looks)) if looks else SIGMAS_OF_LEVEL


def confidence_percent(looks: Sequence[Look]) -> float:
    """Return the confidence of the interval with this many sigmas to each side."""
    return float(100.0 * (1.0 - 2.0 * ndtr(-deviate(looks))))


@functools.lru_cache(maxsize=1024)
def _deviate(looks: tuple[Look, ...]) -> float:
    """Recursion of Armitage, McPherson and Rowe: the score, a Brownian motion in the share, stops at a boundary."""
    places, weights = np.zeros(1), np.ones(1)
    before, found = Look(0.0, 0.0), math.inf
    for look in looks:
        spends, sigma = look.spent - before.spent, math.sqrt(look.share - before.share)
        limit = _boundary(places, weights, sigma, spends, MAX_DEVIATE * math.sqrt(look.share))
        places, weights = _continued(places, weights, sigma, limit)
        before, found = look, limit / math.sqrt(look.share) if spends > _NOTHING else math.inf
    return found


def _boundary(places: FloatArray, weights: FloatArray, sigma: float, spends: float, farthest: float) -> float:
    """Return the score that is exceeded with the probability to be spent."""
    def excess(limit: float) -> float:
        return float(weights @ ndtr((places - limit) / sigma)) - spends

    if excess(farthest) >= 0.0:
        return farthest
    return float(brentq(excess, 0.0, farthest, xtol=1e-10)) if excess(0.0) > 0.0 else 0.0


def _continued(places: FloatArray, weights: FloatArray, sigma: float, limit: float) -> tuple[FloatArray, FloatArray]:
    """Continue a score that has not reached the limits of this look: nodes, and the probability of each (Simpson)."""
    nodes = np.linspace(-limit, limit, _NODES)
    simpson = np.full(_NODES, 2.0)
    simpson[1::2], simpson[0], simpson[-1] = 4.0, 1.0, 1.0
    density = np.exp(-0.5 * ((nodes[:, None] - places) / sigma) ** 2) @ weights / (sigma * math.sqrt(2.0 * math.pi))
    return nodes, simpson * (nodes[1] - nodes[0]) / 3.0 * density
