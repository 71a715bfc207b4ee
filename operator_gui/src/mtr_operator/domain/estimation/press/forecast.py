"""Forecast of a Key press campaign, before it starts and while it runs: presses, robot time, interval.

First the range is halved until the transition's width is left. Then a press near d50 has an information of at most 1 /
(4 scale^2), of which a search that also estimates the width gets EFFICIENCY:

    presses = SEARCH + log2(range / max(width, 2 interval)) + (2 scale * 1.96 / interval)^2 / EFFICIENCY

with a minimum of MIN_PRESSES. Permanent fading belongs to the line and reduces the number of presses.

Information of the logit model: Finney, Probit Analysis; EFFICIENCY and SEARCH fit the medians of radials as in the
range benchmark, on seeds that it does not use.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..interval import SIGMAS_OF_LEVEL
from .plan import SearchPlan
from .radial_search import MIN_PRESSES
from .transition import WIDTH_PER_SCALE

EFFICIENCY = 0.9
SEARCH = 2.0
# Mean distance between presses near d50, without the first path from the far end.
_WAY_HALF_WAVELENGTHS = 1.5


@dataclass(frozen=True)
class RadialForecast:
    """Forecast of one radial.

    Attributes:
        presses, robot_time_s: until the interval is reached, or no press is left.
        interval_m: half the width of the 95 % interval of d50 that is reached.
        is_reached: the required interval can be reached with the allowed presses.
    """

    presses: int
    robot_time_s: float
    interval_m: float
    is_reached: bool


def radial_forecast(plan: SearchPlan, width_m: float) -> RadialForecast:
    """Return the forecast for a transition of this width from 90 to 10 %; robot_time_s assumes d50 in the middle of the
    range."""
    scale_m, span_m = width_m / WIDTH_PER_SCALE, plan.maximum_m - plan.minimum_m
    search = SEARCH + max(0.0, math.log2(span_m / max(width_m, 2.0 * plan.interval_m)))
    one_press_m = 2.0 * scale_m * SIGMAS_OF_LEVEL / math.sqrt(EFFICIENCY)
    presses = max(math.ceil(search + (one_press_m / plan.interval_m) ** 2), min(MIN_PRESSES, plan.attempts_limit))
    if presses <= plan.attempts_limit:
        return RadialForecast(presses, _robot_time(plan, presses), plan.interval_m, True)
    informative = max(plan.attempts_limit - search, 1.0)
    return RadialForecast(plan.attempts_limit, _robot_time(plan, plan.attempts_limit),
                          one_press_m / math.sqrt(informative), False)


def _robot_time(plan: SearchPlan, presses: int) -> float:
    times = plan.times
    press_s = (times.press_s(True) + times.press_s(False)) / 2.0
    first_s = times.way_s((plan.maximum_m - plan.minimum_m) / 2.0)
    return first_s + presses * press_s + (presses - 1) * times.way_s(_WAY_HALF_WAVELENGTHS * plan.half_wavelength_m)
