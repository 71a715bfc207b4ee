"""What a search on each radial is likely to take, and whether the interval wanted can be reached at all."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics
from dataclasses import replace
from typing import Iterator, Sequence

from ...estimation.press.forecast import Forecast, forecast
from ...estimation.press.transition import D95_PER_SCALE, WIDTH_PER_SCALE
from ...prospect import Prospect
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import KeyPressResult

# Widths of the transition before anything is measured: noise of 1 dB in time alone at 8 m, and 5 dB of fading
# (facts of the range benchmark); between them the one for which the interval has to be in reach.
SHARP_M, USUAL_M, SOFT_M = 0.4, 1.0, 2.2
_MAX_ATTEMPTS = KeyPressParameters.declarations()["attempts_limit"].high
# Up to the centimetre that is written.
_ROUNDED_M = 0.005
_MAX_INTERVAL_M = KeyPressParameters.declarations()["interval_m"].high


def prospect(parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> Prospect:
    """From a steady radio to one that fades; with the width that the radials so far show, if there are some."""
    sharp, soft = _forecasts(parameters, results)
    return Prospect((sharp.presses, soft.presses), (sharp.interval_m, soft.interval_m),
                    (sharp.robot_time_s, soft.robot_time_s))


def cautions(parameters: KeyPressParameters) -> Iterator[str]:
    """A sentence when the interval cannot be reached with the presses allowed, and what would."""
    plan = parameters.search_plan
    found = forecast(plan, USUAL_M)
    if found.is_reached:
        return
    enough = forecast(replace(plan, attempts_limit=int(_MAX_ATTEMPTS)), USUAL_M)
    more = f"allow {enough.presses} presses (attempts_limit), or " if enough.is_reached else ""
    yield (f"{plan.attempts_limit} presses on each radial reach an interval of {found.interval_m:.2f} m where the "
           f"Car's range ends within {USUAL_M:g} m; interval_m asks for {plan.interval_m:.2f} m: {more}ask for "
           f"{min(found.interval_m + _ROUNDED_M, _MAX_INTERVAL_M):.2f} m.")


def _forecasts(parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> tuple[Forecast, Forecast]:
    plan = parameters.search_plan
    widths_m = [(result.d50_m - result.d95_m) * WIDTH_PER_SCALE / D95_PER_SCALE for result in results
                if result.d50_m is not None and result.d95_m is not None]
    sharp_m, soft_m = (SHARP_M, SOFT_M) if not widths_m else 2 * (statistics.median(widths_m),)
    return forecast(plan, sharp_m), forecast(plan, soft_m, has_fading=True)
