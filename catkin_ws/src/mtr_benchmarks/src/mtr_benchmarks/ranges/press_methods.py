"""Methods for Key press on one campaign of radials: the thesis' scan, and the adaptive search of the application."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional, Tuple

import numpy as np

from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.plan import RobotTimes, SearchPlan
from mtr_operator.domain.estimation.press.radial_search import RadialSearch

from .cars import HALF_WAVELENGTH_M, Radial, Radio
from .result import LineFound, point

RADIALS = 24
MINIMUM_M, MAXIMUM_M = 3.0, 20.0
# Scan as shipped with the application (examples/key_press.yaml); it records the sigma of the pose.
SCAN_STEP_M, SCAN_ATTEMPTS, SCAN_SIGMA_M = 0.25, 2, 0.002
TIMES = RobotTimes()
PLAN = SearchPlan(MINIMUM_M, MAXIMUM_M, interval_m=0.3, half_wavelength_m=HALF_WAVELENGTH_M, times=TIMES)
# Plan for the same robot time as the scan: no interval ends it, and steps below half a wavelength are allowed.
LONG_PLAN = SearchPlan(MINIMUM_M, MAXIMUM_M, 0.0, 200, HALF_WAVELENGTH_M, TIMES)


class Draw(NamedTuple):
    """Campaign of radials: `place` determines their positions and fading, `noise` the noise."""

    radio: Radio
    place: int
    noise: int

    def radials(self, method: int) -> List[Radial]:
        """Return the same radials for each method, with different noise."""
        place = np.random.default_rng([self.place, 1])
        return [Radial(self.radio, place, np.random.default_rng([self.noise, method, number]))
                for number in range(RADIALS)]


def scan(draw: Draw) -> List[LineFound]:
    """Scan from far to near until the first press works."""
    return [_scanned(radial) for radial in draw.radials(1)]


def _scanned(radial: Radial) -> LineFound:
    presses, time_s, place_m = 0, 0.0, MAXIMUM_M
    while place_m >= MINIMUM_M:
        for _ in range(SCAN_ATTEMPTS):
            presses += 1
            worked = radial.press(place_m)
            time_s += TIMES.press_s(worked)
            if worked:
                return LineFound(radial.d50_m, point(place_m, SCAN_SIGMA_M), presses, time_s, MAXIMUM_M - place_m,
                                 radial.d95_m, point(place_m, SCAN_SIGMA_M))
        place_m -= SCAN_STEP_M
        time_s += TIMES.way_s(SCAN_STEP_M)
    return LineFound(radial.d50_m, point(MINIMUM_M, SCAN_SIGMA_M), presses, time_s, MAXIMUM_M - MINIMUM_M)


def adaptive(draw: Draw, times_s: Optional[List[float]] = None) -> List[LineFound]:
    """Run the application's search. times_s: robot time of each radial, which replaces the interval as end of the
    search."""
    plan = PLAN if times_s is None else LONG_PLAN
    grid = PLAN.hypotheses()
    campaign = Campaign(grid)
    radials = draw.radials(2)
    searches = [RadialSearch(plan, grid, campaign, number, MAXIMUM_M) for number in range(len(radials))]
    efforts = [_searched(radial, search, math.inf if times_s is None else times_s[number])
               for number, (radial, search) in enumerate(zip(radials, searches))]
    found = []
    for radial, search, (time_s, way_m) in zip(radials, searches, efforts):
        search.revisit()
        boundary = search.boundary()
        found.append(LineFound(radial.d50_m, boundary.d50(), len(search.presses), time_s, way_m, radial.d95_m,
                               boundary.d95()))
    return found


def _searched(radial: Radial, search: RadialSearch, limit_s: float) -> Tuple[float, float]:
    """Return robot time and path length."""
    time_s = way_total_m = 0.0
    while time_s < limit_s and not search.is_finished():
        place_m = search.next_place_m()
        way_m = abs(place_m - search.place_m)
        worked = radial.press(place_m)
        time_s += TIMES.way_s(way_m) + TIMES.press_s(worked)
        way_total_m += way_m
        search.add(Press(place_m, worked))
    return time_s, way_total_m
