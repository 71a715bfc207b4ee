"""Capability of a distance: margin of its mean to the nearer limit, in units of three sigmas.

Cpk uses the spread of repetition alone, Ppk the spread of all keys, cars and places together (ISO 22514-2). The 95 %
interval of an index assumes normal distributions and depends on the number of levels of each factor, not of tests. The
interval of the variance combines the intervals of the components (Graybill and Wang, Technometrics 22, 1980). The
interval of the mean uses the sum of the variances over their levels, with degrees of freedom by Welch and
Satterthwaite. In simulated sets of 2 to 5 cars and 15 to 25 tests, 200 each, the interval covers the true value in 93
to 100 % of the sets. With two cars, Ppk is almost unknown.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.estimation.components import Component, Spread
from mtr_operator.domain.estimation.student import quantile

# By convention, the tolerance is compared with this number of sigmas on each side.
_SIGMAS = 3.0


@dataclass(frozen=True)
class Index:
    """Value with its 95 % interval; an end that the tests do not bound is infinite."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Capability:
    """Attributes: within: Cpk, repetition only. overall: Ppk, all factors together."""

    within: Index
    overall: Index


def capability(spread: Spread, at_least_m: float | None, at_most_m: float | None) -> Capability | None:
    """Return the capability of a set of tests against limits in m; None without a limit or without a known spread."""
    rooms = [*([spread.mean - at_least_m] if at_least_m is not None else []),
             *([at_most_m - spread.mean] if at_most_m is not None else [])]
    if not rooms or not spread.components or spread.repeatability <= 0.0:
        return None
    half_m = _half_of_mean(spread.components)
    return Capability(_index(min(rooms), half_m, spread.components[-1:]), _index(min(rooms), half_m, spread.components))


def _index(room_m: float, half_m: float, parts: Sequence[Component]) -> Index:
    """Return an index. half_m: half the 95 % interval of the mean. parts: components of the spread."""
    least_m, sigma_m, most_m = _sigmas(parts)
    value, *ends = (room_m / (_SIGMAS * each_m) if each_m else math.copysign(math.inf, room_m)
                    for each_m in (sigma_m, least_m, most_m))
    by_mean = half_m / (_SIGMAS * sigma_m)
    return Index(value, value - math.hypot(value - min(ends), by_mean), value + math.hypot(max(ends) - value, by_mean))


def _sigmas(parts: Sequence[Component]) -> tuple[float, float, float]:
    """Return 1 sigma of all parts together with its 95 % interval: low, value, high."""
    variance = sum(part.sigma ** 2 for part in parts)
    below = math.hypot(*(part.sigma ** 2 - part.low ** 2 for part in parts))
    above = math.hypot(*(part.high ** 2 - part.sigma ** 2 for part in parts))
    return math.sqrt(max(variance - below, 0.0)), math.sqrt(variance), math.sqrt(variance + above)


def _half_of_mean(parts: Sequence[Component]) -> float:
    """Return half the 95 % interval of the mean in m; each part is averaged over its levels."""
    shares = [part.sigma ** 2 / part.levels for part in parts]
    freedom = sum(shares) ** 2 / sum(share ** 2 / (part.levels - 1) for share, part in zip(shares, parts))
    return quantile(freedom) * math.sqrt(sum(shares))
