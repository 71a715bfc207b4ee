"""Key press on Cars with destructive interference over ground: presses work again beyond a hole, or partly on an
island.

The model has two rays over the ground (mtr_simulation's radio), fading along the radial and noise in time; it is
independent of the estimators' code. The benchmark checks the recorded interval. On a line with several boundaries it
reaches from the nearest to the farthest one; open ends extend to the limits of the test.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import List, NamedTuple

import numpy as np
from scipy.special import ndtr

from mtr_core.arrays import FloatArray
from mtr_operator.domain.estimation.interval import Interval
from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.radial_estimate import estimate
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import ADAPTIVE, KeyPressResult
from mtr_operator.domain.scenarios.line_search.campaign import LineCampaign, concluded, with_estimate
from mtr_simulation.car.honest.radio.two_ray import two_ray_gain_db, wavelength_m
from mtr_simulation.truth.monotone import falls_below

from .press_methods import TIMES
from .result import LineFound

RADIALS = 8
FREQUENCIES_MHZ = (868.0, 433.92)
MINIMUM_M, MAXIMUM_M = 3.0, 18.5
_RECEIVER_M, _PERMITTIVITY, _LAPSE, _WAVES = 1.15, 5.0, 0.02, 48
# Ranges of key height, link margin at 1 m, its spread among radials, fading, and noise in time.
_HEIGHTS_M, _MARGINS_DB, _SPREAD_DB, _FADINGS_DB, _NOISES_DB = (0.8, 1.4), (14.0, 46.0), 1.5, (3.0, 8.0), (2.0, 3.0)
# Limits for the truth of a radial.
_ENDS_M = (4.0, 16.0)
_DISTANCES_M = np.arange(0.5, 30.0, 0.03)


class NullDraw(NamedTuple):
    """One test; place: its seed."""

    mhz: float
    place: int


class NullRadial:
    """Radial over reflecting ground.

    Attributes:
        d50_m: distance at which the non-increasing curve closest to its probability falls below 50 %; NaN if nowhere.
    """

    def __init__(self, draw: NullDraw, radio: FloatArray, seed: List[int]):
        place = np.random.default_rng([*seed, 1])
        self._height_m, self._margin_db, self._fading_db, self._noise_db = radio
        self._margin_db += place.normal(0.0, _SPREAD_DB)
        self._wave_m = wavelength_m(draw.mhz)
        self._waves = 2.0 * math.pi / self._wave_m * place.uniform(-1.0, 1.0, _WAVES)
        self._phases = place.uniform(0.0, 2.0 * math.pi, _WAVES)
        self._chance = np.random.default_rng([*seed, 2])
        self.d50_m = falls_below(_DISTANCES_M, self._works(_DISTANCES_M), 0.5)

    def press(self, distance_m: float) -> bool:
        """Return True if a press works."""
        return bool(self._chance.random() < (1.0 - _LAPSE) * float(self._works(np.array([distance_m]))[0]))

    def _works(self, distances_m: FloatArray) -> FloatArray:
        heights_m = np.full_like(distances_m, self._height_m), _RECEIVER_M
        field = np.sum(np.cos(np.multiply.outer(distances_m, self._waves) + self._phases), axis=-1)
        margin_db = (self._margin_db - 20.0 * np.log10(distances_m)
                     + two_ray_gain_db(distances_m, heights_m, self._wave_m, _PERMITTIVITY)
                     + self._fading_db * math.sqrt(2.0 / _WAVES) * field)
        result: FloatArray = ndtr(margin_db / self._noise_db)
        return result


def radials_of(draw: NullDraw) -> List[NullRadial]:
    """Return the radials of one Car; all of them end within the test."""
    chance = np.random.default_rng([draw.place, round(draw.mhz)])
    while True:
        radio = chance.uniform(*np.array([_HEIGHTS_M, _MARGINS_DB, _FADINGS_DB, _NOISES_DB]).T)
        radials = [NullRadial(draw, radio, [draw.place, number]) for number in range(RADIALS)]
        if all(_ENDS_M[0] < radial.d50_m < _ENDS_M[1] for radial in radials):
            return radials


def over_ground(draw: NullDraw) -> List[LineFound]:
    """Run one test as the application does; an open end of an interval is set to 0, or far beyond the test."""
    radials = radials_of(draw)
    plan = replace(KeyPressParameters(
        minimum_distance_m=MINIMUM_M, maximum_distance_m=MAXIMUM_M + 0.5, interval_m=0.3,
        key_frequency_hz=1e6 * draw.mhz).search_plan, times=TIMES)
    campaign, results, times_s = LineCampaign(plan), [], []
    for number, radial in enumerate(radials, 1):
        search, time_s = campaign.search(number), 0.0
        while not search.is_finished():
            place_m = search.next_place_m()
            worked = radial.press(place_m)
            time_s += TIMES.way_s(abs(place_m - search.place_m)) + TIMES.press_s(worked)
            search.add(Press(place_m, worked))
        found = KeyPressResult(
            number, 0.0, LineStatus.OK, None, None, None, len(search.presses), None, "", method=ADAPTIVE,
            worked_at_m=tuple(press.distance_m for press in search.presses if press.worked),
            failed_at_m=tuple(press.distance_m for press in search.presses if not press.worked), place_sigma_m=0.002)
        results.append(with_estimate(plan, found, estimate(plan, search)))
        times_s.append(time_s)
    last = {result.number: result for result in [*results, *concluded(plan, results)]}
    return [LineFound(radial.d50_m, _reported(last[number]), last[number].attempts, time_s)
            for number, (radial, time_s) in enumerate(zip(radials, times_s), 1)]


def _reported(result: KeyPressResult) -> Interval:
    low_m = 0.0 if result.d50_low_m is None else result.d50_low_m
    high_m = float(_DISTANCES_M[-1]) if result.d50_high_m is None else result.d50_high_m
    value_m = (low_m + high_m) / 2.0 if result.d50_m is None else result.d50_m
    return Interval(value_m, low_m, high_m, (high_m - low_m) / 4.0)
