"""What a search on each line is likely to take, and whether the interval wanted can be reached at all."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics
from dataclasses import dataclass, replace
from typing import Iterator, Sequence

from ...estimation.press.forecast import RadialForecast, radial_forecast
from ...estimation.press.plan import SearchPlan
from ...estimation.press.transition import D95_PER_SCALE, WIDTH_PER_SCALE
from ...forecast import Forecast
from .result import SearchedResult

# Up to the centimetre that is written.
_ROUNDED_M = 0.005


@dataclass(frozen=True)
class UsualWidths:
    """Widths of the transition before anything is measured, in m; for the usual one the interval has to be in reach."""

    sharp_m: float
    usual_m: float
    soft_m: float


@dataclass(frozen=True)
class SearchLimits:
    """What a sentence on a search names: attempts, "presses on each radial", and how far its parameters go."""

    attempts: str
    max_attempts: int
    max_interval_m: float


def search_forecast(plan: SearchPlan, widths: UsualWidths, results: Sequence[SearchedResult]) -> Forecast:
    """From a sharp end of the range to a soft one; with the width that the lines so far show, if there are some."""
    sharp, soft = _forecasts(plan, widths, results)
    return Forecast((sharp.presses, soft.presses), (sharp.interval_m, soft.interval_m),
                    (sharp.robot_time_s, soft.robot_time_s))


def cautions(plan: SearchPlan, widths: UsualWidths, limits: SearchLimits) -> Iterator[str]:
    """A sentence when the interval cannot be reached with the attempts allowed, and what would."""
    found = radial_forecast(plan, widths.usual_m)
    if found.is_reached:
        return
    enough = radial_forecast(replace(plan, attempts_limit=limits.max_attempts), widths.usual_m)
    what = limits.attempts.split(" on ", maxsplit=1)[0]
    more = f"allow {enough.presses} {what} (attempts_limit), or " if enough.is_reached else ""
    yield (f"{plan.attempts_limit} {limits.attempts} reach an interval of {found.interval_m:.2f} m where the "
           f"Car's range ends within {widths.usual_m:g} m; interval_m asks for {plan.interval_m:.2f} m: {more}ask for "
           f"{min(found.interval_m + _ROUNDED_M, limits.max_interval_m):.2f} m.")


def _forecasts(plan: SearchPlan, widths: UsualWidths,
               results: Sequence[SearchedResult]) -> tuple[RadialForecast, RadialForecast]:
    widths_m = [(result.d50_m - result.d95_m) * WIDTH_PER_SCALE / D95_PER_SCALE for result in results
                if result.d50_m is not None and result.d95_m is not None]
    sharp_m, soft_m = (widths.sharp_m, widths.soft_m) if not widths_m else 2 * (statistics.median(widths_m),)
    return radial_forecast(plan, sharp_m), radial_forecast(plan, soft_m)
