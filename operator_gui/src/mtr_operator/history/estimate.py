"""A quantity as one test or a set of tests knows it: a value with its 95 % interval, or an end of it alone.

The mean of repeated tests has the interval of Student's t from their spread, widened by what no repetition shows (the
errors of robot and calibration, and what passes cannot tell of a Car, which all tests have alike). Where a test knows
only that the quantity lies beyond an end, that end stands for it: the mean then has one end as well, and no value.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.estimation.student import quantile

NOT_MEASURED = "No test measured it."


@dataclass(frozen=True)
class Known:
    """Of one test. value: None where only ends are known; low, high: between which it lies for sure, the value itself
    where there is one. ends: 95 % interval, None where the method gives none.

    reason: why nothing is known although something was measured, a sentence; empty when it is.

    Parts of the errors, 1 sigma, each a part of the one before: coherent: what all lines of the test have alike, so
    that their mean has it as well. shared: what repeating the test does not show. alike: what each test of the same
    Car has again, for sure; alike_timing: the same of its timing."""

    value: float | None
    low: float
    high: float
    ends: tuple[float, float] | None
    coherent: float = 0.0
    shared: float = 0.0
    alike: float = 0.0
    alike_timing: float = 0.0
    reason: str = ""


@dataclass(frozen=True)
class Estimate:
    """Of one test, or the mean of several. count: of tests. freedom: degrees of freedom of the interval. spread: 1
    sigma between the tests, None for one. low, high: 95 % interval, infinite where an end is open. alike: see Known.
    reason: why there is no interval, a sentence; empty when there is one."""

    value: float | None
    low: float
    high: float
    count: int
    freedom: float = math.inf
    spread: float | None = None
    alike: float = 0.0
    reason: str = ""

    @property
    def is_open(self) -> bool:
        """An end of the interval is not known."""
        return not (math.isfinite(self.low) and math.isfinite(self.high))


def estimate(known: Sequence[Known], without: str = NOT_MEASURED) -> Estimate:
    """What tests say together of one quantity. without: reason if no test knows anything of it."""
    if not known:
        return Estimate(None, -math.inf, math.inf, 0, reason=without)
    unknown = next((each.reason for each in known if each.reason), "")
    if unknown:
        return Estimate(None, -math.inf, math.inf, len(known), reason=unknown)
    if len(known) == 1:
        only = known[0]
        if only.ends is None:
            return Estimate(only.value, -math.inf, math.inf, 1, reason="One test that does not say how sure it is.")
        return Estimate(only.value, *only.ends, 1, alike=only.alike)
    count, shared = len(known), max(each.shared for each in known)
    alike = min(math.hypot(each.alike, each.alike_timing) for each in known)
    lows, highs = (np.array([getattr(each, name) for each in known]) for name in ("low", "high"))
    low, high = _end(lows, -1.0, shared), _end(highs, 1.0, shared)
    if any(each.value is None for each in known):
        return Estimate(None, low, high, count, count - 1.0, alike=alike)
    return Estimate(float(np.mean(lows)), low, high, count, count - 1.0, float(np.std(lows, ddof=1)), alike)


def _end(values: np.ndarray[tuple[int], np.dtype[np.float64]], sign: float, shared: float) -> float:
    if not np.all(np.isfinite(values)):
        return sign * math.inf
    reach = quantile(len(values) - 1.0) * float(np.std(values, ddof=1)) / math.sqrt(len(values))
    return float(np.mean(values)) + sign * math.hypot(reach, SIGMAS_OF_LEVEL * shared)
