"""What a campaign of Key press will take, before it is started and while it runs: presses, robot time, interval.

Of a search: first the range is halved until the transition's width is left, then each press near d50 tells at most
1 / (4 scale^2), of which a search that also learns the width gets EFFICIENCY:

    presses = SEARCH + log2(range / max(width, 2 interval)) + (2 scale * 1.96 / interval)^2 / EFFICIENCY

With fading a half wavelength along the radial is worth one press, however often it is pressed there: the interval
cannot fall below that of one press in each half wavelength of the transition,

    sigma^2 >= half_wavelength * sigma_transition / 1.8,   1.8 = integral of phi^2 / (Phi (1 - Phi)).

Information of the probit and logit models: Finney, Probit Analysis; EFFICIENCY and SEARCH fit the medians of radials of
the range benchmark's kind, on seeds that it does not use.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..interval import SIGMAS_OF_LEVEL
from .plan import SearchPlan
from .transition import SIGMA_PER_SCALE, WIDTH_PER_SCALE

EFFICIENCY = 0.9
SEARCH = 2.0
_PROBIT_INFORMATION = 1.8
# Of the ways between presses near d50, beside the first one from the far end.
_WAY_HALF_WAVELENGTHS = 1.5


@dataclass(frozen=True)
class Forecast:
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


def forecast(plan: SearchPlan, width_m: float, has_fading: bool = False) -> Forecast:
    """For a transition of a width from 90 to 10 %; robot_time_s takes d50 in the middle of the range."""
    scale_m, span_m = width_m / WIDTH_PER_SCALE, plan.maximum_m - plan.minimum_m
    search = SEARCH + max(0.0, math.log2(span_m / max(width_m, 2.0 * plan.interval_m)))
    one_press_m = 2.0 * scale_m * SIGMAS_OF_LEVEL / math.sqrt(EFFICIENCY)
    presses = math.ceil(search + (one_press_m / plan.interval_m) ** 2)
    floor_m = _fading_floor(plan, scale_m) if has_fading else 0.0
    informative = max(plan.attempts_limit - search, 1.0)
    is_reached = presses <= plan.attempts_limit and floor_m <= plan.interval_m
    if is_reached:
        return Forecast(presses, _robot_time(plan, presses), plan.interval_m, True)
    reached_m = max(floor_m, one_press_m / math.sqrt(informative))
    return Forecast(plan.attempts_limit, _robot_time(plan, plan.attempts_limit), reached_m, False)


def _fading_floor(plan: SearchPlan, scale_m: float) -> float:
    sigma_m = math.sqrt(plan.half_wavelength_m * SIGMA_PER_SCALE * scale_m / _PROBIT_INFORMATION)
    return SIGMAS_OF_LEVEL * sigma_m


def _robot_time(plan: SearchPlan, presses: int) -> float:
    times = plan.times
    press_s = (times.press_s(True) + times.press_s(False)) / 2.0
    first_s = times.way_s((plan.maximum_m - plan.minimum_m) / 2.0)
    return first_s + presses * press_s + (presses - 1) * times.way_s(_WAY_HALF_WAVELENGTHS * plan.half_wavelength_m)
