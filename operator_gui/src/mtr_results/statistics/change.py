"""The difference of a quantity between two sides of a comparison, each a test or a set of tests.

Errors that both sides of a comparison have alike cancel in their difference: by so much the intervals of both are
narrowed before it is taken. Tests of the same Car have its outline in common, and what passes cannot tell of its
timing. The latter sets alone may take out, whose spread shows each line's own noise: a single test says of all lines
the same, and where the field falls slowly that is too little.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.history.comparison import difference_interval
from mtr_operator.history.estimate import Estimate

from .multiplicity import chance


@dataclass(frozen=True)
class Change:
    """Of one quantity, second less first. chance: see multiplicity; 1 where nothing is known."""

    value: float | None
    low: float
    high: float
    chance: float
    reason: str = ""


def change(first: Estimate, second: Estimate) -> Change:
    """The difference of two estimates, with the interval that follows from both (MOVER)."""
    value = None if first.value is None or second.value is None else second.value - first.value
    for number, each in ((1, first), (2, second)):
        if each.reason:
            return Change(value, -math.inf, math.inf, 1.0, f"Side {number}: {each.reason}")
    alike = min(first.alike, second.alike)
    low, high = difference_interval([first.value, second.value], *(_narrowed(each, alike) for each in (first, second)))
    return Change(value, low, high, chance(value, low, high, min(first.freedom, second.freedom)))


def _narrowed(each: Estimate, sigma: float) -> tuple[float, float]:
    """Its interval without an independent error; an end that is not known, or of no value, stays as it is."""
    if each.value is None or sigma == 0.0:
        return each.low, each.high
    below, above = (math.sqrt(max(reach ** 2 - (SIGMAS_OF_LEVEL * sigma) ** 2, 0.0))
                    for reach in (each.value - each.low, each.high - each.value))
    return each.value - below, each.value + above
