"""Capability of a distance: how far its mean is from the nearer limit, in units of three of its own sigmas.

Cpk counts the spread of repetition alone, Ppk that of all keys, cars and places together (ISO 22514-2). The 95 %
interval of an index is that of Bissell (Applied Statistics 39, 1990), a normal distribution assumed: with ten tests an
index of 1.3 may as well be 0.7.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from mtr_operator.domain.estimation.components import Spread
from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL

# By custom: so many sigmas on a side.
_SIGMAS = 3.0


@dataclass(frozen=True)
class Index:
    """Value with its 95 % interval; infinite or not known without a spread."""

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
    return Capability(_index(min(rooms), spread.repeatability, spread.count),
                      _index(min(rooms), spread.reproducibility, spread.count))


def _index(room_m: float, sigma_m: float, count: int) -> Index:
    value = room_m / (_SIGMAS * sigma_m)
    half = SIGMAS_OF_LEVEL * math.sqrt(1.0 / (_SIGMAS ** 2 * count) + value ** 2 / (2.0 * (count - 1)))
    return Index(value, value - half, value + half)
