"""Forecast of a zone before and during its measurement: presses, and the interval of its coverage ratio.

Each press is assumed to contribute equally, in addition to the prior:

    1 / half_width^2 = 1 / BEFORE^2 + presses / spread

BEFORE is half the width of the 95 % interval of an unmeasured part. With the spreads, 24 presses yield the medians of
docs/lab-notebook/accuracy.md for fields that fall from 90 to 10 % within 0.5, 2 and 4 m. On eleven other such fields
(seeds 101 to 104) the medians after 6 to 24 presses were within 10 % of the formula. After 64 presses the interval of a
sharp field was narrower (0.05 instead of 0.08), and of a soft field wider (0.13 instead of 0.11). A zone with measured
neighbours needs fewer presses, not more.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from .zone_search import MIN_PRESSES

BEFORE = 0.49
SHARP, USUAL, SOFT = 0.44, 0.69, 0.79


@dataclass(frozen=True)
class ZoneForecast:
    """Forecast of one zone.

    Attributes:
        presses: until the interval is reached, or no press is left.
        half_width: of the 95 % interval of the coverage that is reached, 0 to 1.
        is_reached: the required interval can be reached with the allowed presses.
    """

    presses: int
    half_width: float
    is_reached: bool


def zone_forecast(half_width: float, presses_limit: int, spread: float) -> ZoneForecast:
    """Return the forecast for the required half width, 0 to 1."""
    needed = math.ceil(spread * max(half_width ** -2 - BEFORE ** -2, 0.0))
    presses = max(needed, min(MIN_PRESSES, presses_limit))
    if presses <= presses_limit:
        return ZoneForecast(presses, min(half_width, _reached(presses, spread)), True)
    return ZoneForecast(presses_limit, _reached(presses_limit, spread), False)


def _reached(presses: int, spread: float) -> float:
    return 1.0 / math.sqrt(BEFORE ** -2 + presses / spread)
