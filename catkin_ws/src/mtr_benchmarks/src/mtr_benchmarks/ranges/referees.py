"""Reference methods on the same draws: Neyer's D-optimal design (senpy-sensei, if installed) and an up-and-down."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, List

import numpy as np

from .cars import Radial
from .press_methods import MAXIMUM_M, MINIMUM_M, PLAN, TIMES, Draw
from .result import LineFound, point

try:
    from senpy.neyer import Neyer
except ImportError:
    Neyer = None

PRESSES = PLAN.attempts_limit
_STEP_M = 0.5


def up_and_down(draw: Draw) -> List[LineFound]:
    """Bisect until the step is 0.5 m, then keep it; the result is the mean of the places (Dixon and Mood, 1948)."""
    return [_walked(radial) for radial in draw.radials(5)]


def _walked(radial: Radial) -> LineFound:
    place_m, step_m = (MINIMUM_M + MAXIMUM_M) / 2.0, (MAXIMUM_M - MINIMUM_M) / 4.0
    time_s, way_total_m, places = 0.0, MAXIMUM_M - place_m, []
    for _ in range(PRESSES):
        worked = radial.press(place_m)
        time_s += TIMES.press_s(worked) + TIMES.way_s(step_m)
        way_total_m += step_m
        if step_m <= _STEP_M:
            places.append(place_m)
        place_m = float(np.clip(place_m + (step_m if worked else -step_m), MINIMUM_M, MAXIMUM_M))
        step_m = max(step_m / 2.0, _STEP_M)
    sigma_m = float(np.std(places)) / math.sqrt(len(places))
    return LineFound(radial.d50_m, point(float(np.mean(places)), sigma_m), PRESSES, time_s, way_total_m)


def neyer(draw: Draw, radials: int) -> List[LineFound]:
    """Run the design on the first radials of a draw; it has no interval. Without senpy the result is empty."""
    return [] if Neyer is None else [_designed(radial) for radial in draw.radials(6)[:radials]]


def _designed(radial: Radial) -> LineFound:
    # With limits of its own, senpy prompts on the terminal if a place exceeds them, and ends.
    design: Any = Neyer(latent="logistic", inverted=True, t1_min=MINIMUM_M, t1_max=MAXIMUM_M, t2_guess=0.5,
                        num_restarts=1)
    time_s, way_total_m, before_m = 0.0, 0.0, MAXIMUM_M
    places: Dict[bool, List[float]] = {True: [], False: []}
    for _ in range(PRESSES):
        place_m = float(np.clip(float(design.next_pt()), MINIMUM_M, MAXIMUM_M))
        worked = radial.press(place_m)
        time_s += TIMES.press_s(worked) + TIMES.way_s(abs(place_m - before_m))
        way_total_m += abs(place_m - before_m)
        before_m = place_m
        places[worked].append(place_m)
        design.post_test_outcome(int(worked), place_m)
    # Without successes beyond failures, the maximum likelihood has no width, and the design no estimate.
    overlap = max(places[True], default=-math.inf) > min(places[False], default=math.inf)
    d50_m = float(design.get_estimators()[0]) if overlap else before_m
    d50_m = float(np.clip(d50_m, MINIMUM_M, MAXIMUM_M))
    return LineFound(radial.d50_m, point(d50_m, math.nan), PRESSES, time_s, way_total_m)
