"""Capability of a distance: how far its mean is from the nearer limit, in units of three of its own sigmas.

Cpk counts the spread of repetition alone, Ppk that of all keys, cars and places together (ISO 22514-2). The 95 %
interval of an index, of normal distributions, is as sure as there are levels of each factor, not tests: that of the
variance joins the components' own intervals (Graybill and Wang, Technometrics 22, 1980); that of the mean has the sum
of their variances by their levels, and degrees of freedom by Welch and Satterthwaite. In simulated sets of 2 to 5 cars
and 15 to 25 tests, 200 each, it holds in 93 to 100 % of them. Two cars leave hardly anything known of Ppk.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.estimation.components import Component, Spread
from mtr_operator.domain.estimation.student import quantile

# By custom: so many sigmas on a side.
_SIGMAS = 3.0


@dataclass(frozen=True)
class Index:
    """Value with its 95 % interval; an end is infinite where the tests do not bound it."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Capability:
    """Attributes: within: Cpk, of repetition. overall: Ppk, of all factors together."""

    within: Index
    overall: Index


def capability(spread: Spread, at_least_m: float | None, at_most_m: float | None) -> Capability | None:
    """Of the distances of a set of tests against limits in m; None without a limit, or where nothing is known of the
    spread."""
    rooms = [*([spread.mean - at_least_m] if at_least_m is not None else []),
             *([at_most_m - spread.mean] if at_most_m is not None else [])]
    if not rooms or not spread.components or spread.repeatability <= 0.0:
        return None
    half_m = _half_of_mean(spread.components)
    return Capability(_index(min(rooms), half_m, spread.components[-1:]), _index(min(rooms), half_m, spread.components))


def _index(room_m: float, half_m: float, parts: Sequence[Component]) -> Index:
    """half_m: half the 95 % interval of the mean. parts: of the spread that counts."""
    least_m, sigma_m, most_m = _sigmas(parts)
    value, *ends = (room_m / (_SIGMAS * each_m) if each_m else math.copysign(math.inf, room_m)
                    for each_m in (sigma_m, least_m, most_m))
    by_mean = half_m / (_SIGMAS * sigma_m)
    return Index(value, value - math.hypot(value - min(ends), by_mean), value + math.hypot(max(ends) - value, by_mean))


def _sigmas(parts: Sequence[Component]) -> tuple[float, float, float]:
    """1 sigma of all parts together, between the ends of its 95 % interval: the least, itself, the most."""
    variance = sum(part.sigma ** 2 for part in parts)
    below = math.hypot(*(part.sigma ** 2 - part.low ** 2 for part in parts))
    above = math.hypot(*(part.high ** 2 - part.sigma ** 2 for part in parts))
    return math.sqrt(max(variance - below, 0.0)), math.sqrt(variance), math.sqrt(variance + above)


def _half_of_mean(parts: Sequence[Component]) -> float:
    """Half the 95 % interval of the mean in m: each part averages over its levels."""
    shares = [part.sigma ** 2 / part.levels for part in parts]
    freedom = sum(shares) ** 2 / sum(share ** 2 / (part.levels - 1) for share, part in zip(shares, parts))
    return quantile(freedom) * math.sqrt(sum(shares))
