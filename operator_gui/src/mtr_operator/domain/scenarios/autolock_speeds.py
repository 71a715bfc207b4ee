"""How fast the key passes on each go of an axis, and what that is worth on a Car that tells its state in cycles."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator, Sequence

from ..estimation.interval import SIGMAS_OF_LEVEL
from ..estimation.passes.delay import has_two_speeds
from ..estimation.passes.speeds import intercept_sigma, pass_sigma, proposed_slow_speed, proposed_speed
from ..forecast import Forecast
from .autolock_parameters import MIN_SPEED_MPS, AutolockParameters
from .autolock_result import AutolockResult

# Most cars look for the key every 100 to 700 ms; no bus tells it.
USUAL_POLL_S = 0.3
# Bodies of cars tell the state of their locks every 20 to 800 ms.
USUAL_CYCLE_S = 0.2
# Of a further pass: what is driven at its speed, and the time to turn round and go back.
FURTHER_M, TURNING_S = 1.7, 6.0
# A hundredth over is rounding of the speed that was proposed.
_ROUNDING = 1.01
# Proposed for the first of several passes.
_FAST_MPS = 0.4


def pass_speeds(parameters: AutolockParameters, cycle_s: float) -> tuple[float, ...]:
    """Speed limit of each pass in m/s; cycle_s: of the message that tells the state of the locks."""
    given = parameters.measuring_speeds_mps
    if given is None and parameters.passes == 1:
        given = (parameters.speed_on_axis_mps,)
    elif given is None:
        given = _proposed(parameters, cycle_s)
    return tuple(given[number % len(given)] for number in range(parameters.passes))


def expected_sigma(parameters: AutolockParameters, cycle_s: float) -> float:
    """1 sigma in m of the static boundary of an axis from its own passes; infinite when they are at one speed."""
    speeds_mps = pass_speeds(parameters, cycle_s)
    if not has_two_speeds(speeds_mps):
        return float("inf")
    return intercept_sigma(min(speeds_mps), max(speeds_mps), USUAL_POLL_S, cycle_s)


def pass_forecast(parameters: AutolockParameters, cycle_s: float, line_s: float,
                  results: Sequence[AutolockResult]) -> Forecast:
    """Of each axis; the interval is that of the static boundary, before others are measured from its own passes."""
    known_m = [(high_m - low_m) / 2.0 for result in results
               for low_m, high_m in ((result.unlock_static_low_m, result.unlock_static_high_m),
                                     (result.lock_static_low_m, result.lock_static_high_m))
               if low_m is not None and high_m is not None]
    sigma_m = expected_sigma(parameters, cycle_s)
    if known_m:
        interval_m: tuple[float, float] | None = (min(known_m), max(known_m))
    else:
        interval_m = 2 * (SIGMAS_OF_LEVEL * sigma_m,) if math.isfinite(sigma_m) else None
    passes = parameters.passes + (parameters.last_step_m is not None)
    return Forecast((passes, passes), interval_m, (line_s, line_s))


def speed_cautions(parameters: AutolockParameters, cycle_s: float) -> Iterator[str]:
    """Sentences on speeds that do not hold the budget asked for."""
    speeds_mps = pass_speeds(parameters, cycle_s)
    if len(speeds_mps) == 1:
        # An approach in steps stands still where it is told.
        if parameters.last_step_m is None:
            yield from _caution_of_one(speeds_mps[0], parameters, cycle_s)
        return
    if not has_two_speeds(speeds_mps):
        yield ("All passes have about the same speed, so that the Car's reaction time stays inside the distances; give "
               "measuring_speeds_mps two speeds.")
        return
    sigma_m = expected_sigma(parameters, cycle_s)
    if sigma_m > _ROUNDING * parameters.boundary_sigma_m:
        slow_mps = proposed_slow_speed(parameters.boundary_sigma_m, max(speeds_mps), USUAL_POLL_S, cycle_s)
        least_m = intercept_sigma(MIN_SPEED_MPS, max(speeds_mps), USUAL_POLL_S, cycle_s)
        yield (f"At {min(speeds_mps):.2f} m/s, with a message of the Car every {cycle_s:.2f} s, the static boundary of "
               f"an axis has a sigma of {sigma_m:.3f} m; boundary_sigma_m asks for "
               f"{parameters.boundary_sigma_m:.3f} m. {_remedy(slow_mps, least_m)}")


def _caution_of_one(speed_mps: float, parameters: AutolockParameters, cycle_s: float) -> Iterator[str]:
    """Of a single pass the message's cycle alone counts: the Car's own reaction time is inside its distance anyway."""
    sigma_m = pass_sigma(speed_mps, 0.0, cycle_s)
    if sigma_m > _ROUNDING * parameters.boundary_sigma_m:
        enough_mps = proposed_speed(parameters.boundary_sigma_m, 0.0, cycle_s)
        yield (f"At {speed_mps:.2f} m/s, with a message of the Car every {cycle_s:.2f} s, the distance of a pass has a "
               f"sigma of {sigma_m:.3f} m by that message alone; boundary_sigma_m asks for "
               f"{parameters.boundary_sigma_m:.3f} m. {_remedy(enough_mps, pass_sigma(MIN_SPEED_MPS, 0.0, cycle_s))}")


def _remedy(speed_mps: float, least_sigma_m: float) -> str:
    """What would do; least_sigma_m: at the lowest speed that is allowed. Rounded to the side that does."""
    if speed_mps >= MIN_SPEED_MPS:
        return f"Pass at {math.floor(100.0 * speed_mps) / 100.0:.2f} m/s."
    return f"Ask for {math.ceil(1000.0 * least_sigma_m) / 1000.0:.3f} m, and pass at {MIN_SPEED_MPS:.2f} m/s."


def _proposed(parameters: AutolockParameters, cycle_s: float) -> tuple[float, float]:
    fast_mps = parameters.measuring_speed_mps or min(parameters.maximum_speed_mps, _FAST_MPS)
    slow_mps = proposed_slow_speed(parameters.boundary_sigma_m, fast_mps, USUAL_POLL_S, cycle_s)
    return fast_mps, max(MIN_SPEED_MPS, min(slow_mps, fast_mps / 2.0))
