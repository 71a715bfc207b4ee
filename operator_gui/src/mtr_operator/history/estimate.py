"""Estimate of a quantity by one test or a set of tests: a value with its 95 % interval, or only one end of it.

The mean of repeated tests has the interval of Student's t from their spread, widened by errors that repetition does not
show: errors of robot and calibration, and the part of a Car's timing that passes cannot resolve. If a test knows only
that the quantity lies beyond an end, it counts with that end: the mean then has one end as well, and no value.
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
    """Result of one test. value: None if only ends are known; low, high: certain bounds, equal to the value if there is
    one. ends: 95 % interval, None if the method gives none.

    reason: sentence why nothing is known despite a measurement; empty otherwise.

    Parts of the errors, 1 sigma, each included in the previous one: coherent: common to all lines of the test, and thus
    to their mean. shared: not shown by repeating the test. alike: common to all tests of the same Car; alike_timing:
    the timing part of it.
    """

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
    """Result of one test, or the mean of several. count: of tests. freedom: degrees of freedom of the interval. spread:
    1 sigma between the tests, None for one. low, high: 95 % interval, infinite for an open end. alike: see Known.
    reason: sentence why there is no interval; empty if there is one."""

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
        """True if an end of the interval is unknown."""
        return not (math.isfinite(self.low) and math.isfinite(self.high))


def estimate(known: Sequence[Known], without: str = NOT_MEASURED) -> Estimate:
    """Combine the results of several tests. without: reason if no test has a result."""
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
