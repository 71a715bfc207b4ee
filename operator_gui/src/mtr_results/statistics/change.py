"""Difference of a quantity between two sides of a comparison, each a test or a set of tests.

Errors that are common to both sides cancel in the difference, so the intervals of both sides are narrowed first. Tests
of the same Car have the error of its outline in common, and the part of its timing that passes cannot resolve. The
timing part is removed only for sets, whose spread shows the noise of each line. A single test has one estimate for all
lines, which is too small if the field decays slowly.
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
    """Difference of one quantity, second less first. chance: see multiplicity; 1 if unknown."""

    value: float | None
    low: float
    high: float
    chance: float
    reason: str = ""


def change(first: Estimate, second: Estimate) -> Change:
    """Return the difference of two estimates with its interval, by MOVER."""
    value = None if first.value is None or second.value is None else second.value - first.value
    for number, each in ((1, first), (2, second)):
        if each.reason:
            return Change(value, -math.inf, math.inf, 1.0, f"Side {number}: {each.reason}")
    alike = min(first.alike, second.alike)
    low, high = difference_interval([first.value, second.value], *(_narrowed(each, alike) for each in (first, second)))
    return Change(value, low, high, chance(value, low, high, min(first.freedom, second.freedom)))


def _narrowed(each: Estimate, sigma: float) -> tuple[float, float]:
    """Return the interval without an independent error; open intervals or those without a value do not change."""
    if each.value is None or sigma == 0.0:
        return each.low, each.high
    below, above = (math.sqrt(max(reach ** 2 - (SIGMAS_OF_LEVEL * sigma) ** 2, 0.0))
                    for reach in (each.value - each.low, each.high - each.value))
    return each.value - below, each.value + above
