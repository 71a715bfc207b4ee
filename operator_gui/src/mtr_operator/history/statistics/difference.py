"""Difference of a quantity between two sides of a comparison, each a test or a set of tests.

The interval of a difference follows from the intervals of both sides (MOVER: Zou and Donner 2008, Statistics in
Medicine 27, 1693): from a + [a - low_a, high_a - a] and the same of b,

    b - a - hypot(b - low_b, high_a - a)  to  b - a + hypot(high_b - b, a - low_a)

Errors that are common to both sides cancel in the difference, so the intervals of both sides are narrowed first. Tests
of the same Car have the error of its outline in common, and the part of its timing that passes cannot resolve. The
timing part is removed only for sets, whose spread shows the noise of each line. A single test has one estimate for all
lines, which is too small if the field decays slowly.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.history.distance_reader import Ends
from mtr_operator.history.estimate import Estimate

from .multiplicity import chance


class Change(enum.Enum):
    """Result for one quantity, second side less first side."""

    FARTHER = "farther"
    NEARER = "nearer"
    NOT_SHOWN = "no difference shown"
    NOT_KNOWN = "not known"


@dataclass(frozen=True)
class Difference:
    """Difference of one quantity, second less first. chance: see multiplicity; 1 if unknown. reason: why there is no
    interval, a sentence; empty if there is one."""

    value: float | None
    low: float
    high: float
    chance: float
    reason: str = ""


def difference(first: Estimate, second: Estimate) -> Difference:
    """Return the difference of two estimates with its interval, by MOVER."""
    value = None if first.value is None or second.value is None else second.value - first.value
    for number, each in ((1, first), (2, second)):
        if each.reason:
            return Difference(value, -math.inf, math.inf, 1.0, f"Side {number}: {each.reason}")
    alike = min(first.alike, second.alike)
    low, high = _interval([first.value, second.value], *(_narrowed(each, alike) for each in (first, second)))
    return Difference(value, low, high, chance(value, low, high, min(first.freedom, second.freedom)))


def _narrowed(each: Estimate, sigma: float) -> Ends:
    """Return the interval without an independent error; open intervals or those without a value do not change."""
    if each.value is None or sigma == 0.0:
        return each.low, each.high
    below, above = (math.sqrt(max(reach ** 2 - (SIGMAS_OF_LEVEL * sigma) ** 2, 0.0))
                    for reach in (each.value - each.low, each.high - each.value))
    return each.value - below, each.value + above


def _interval(values: Sequence[float | None], first: Ends, second: Ends) -> Ends:
    """Return the interval of the second value less the first from the intervals of both; None for an unknown value."""
    a, b = (_middle(value, ends) for value, ends in zip(values, (first, second)))
    if a is None or b is None:
        return second[0] - first[1], second[1] - first[0]
    return (b - a - math.hypot(b - second[0], first[1] - a), b - a + math.hypot(second[1] - b, a - first[0]))


def _middle(value: float | None, ends: Ends) -> float | None:
    """Return a value within both ends; None if one of them is unknown."""
    if not all(map(math.isfinite, ends)):
        return None
    return value if value is not None and ends[0] <= value <= ends[1] else sum(ends) / 2.0
