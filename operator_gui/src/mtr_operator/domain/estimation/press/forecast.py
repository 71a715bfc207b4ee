"""What a campaign of Key press will take, before it is started and while it runs: presses, robot time, interval.

Of a search: first the range is halved until the transition's width is left, then each press near d50 tells at most
1 / (4 scale^2), of which a search that also learns the width gets EFFICIENCY:

    presses = SEARCH + log2(range / max(width, 2 interval)) + (2 scale * 1.96 / interval)^2 / EFFICIENCY

but MIN_PRESSES at least. Fading that stays in its place belongs to the line and takes fewer presses, not more.

Information of the logit model: Finney, Probit Analysis; EFFICIENCY and SEARCH fit the medians of radials of the range
benchmark's kind, on seeds that it does not use.
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
# Of the ways between presses near d50, beside the first one from the far end.
_WAY_HALF_WAVELENGTHS = 1.5


@dataclass(frozen=True)
class RadialForecast:
    """Of one radial.

    Attributes:
        presses, robot_time_s: until the interval is reached, or no press is left.
        interval_m: half the width of the 95 % interval of d50 that is reached.
        is_reached: the interval that is wanted can be reached with the presses allowed.
    """

    presses: int
    robot_time_s: float
    interval_m: float
    is_reached: bool


def radial_forecast(plan: SearchPlan, width_m: float) -> RadialForecast:
    """For a transition of a width from 90 to 10 %; robot_time_s takes d50 in the middle of the range."""
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
