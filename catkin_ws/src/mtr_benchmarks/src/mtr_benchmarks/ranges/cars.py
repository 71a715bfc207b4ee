"""Cars of this benchmark: one radial of a transition with fading and random misses, one axis that is polled.

The code is independent of the estimators, so that an error in one is not in the other. On a radial, the probability
p(d) that a press works is logistic in the distance. Fading is a normal field along the radial, a sum of waves whose
correlation is sinc(2 pi r / wavelength). A press works when
    Phi(sqrt(share) * field(d) + sqrt(1 - share) * noise) < p(d),
which leaves p(d) unchanged on the average over places.

The truth of a radial is the distance at which the non-increasing curve closest to its own probability of a reaction
falls below a level. This probability includes the radial's fading, as in truth.csv of the simulation.
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, ndtr, ndtri

from mtr_core.arrays import FloatArray
from mtr_simulation.truth.monotone import falls_below

WIDTH_PER_SCALE = 2.0 * math.log(9.0)
# Step and extent of the search for the truth of a radial: beyond this number of widths no press works.
_STEP_M, _WIDTHS_BEYOND = 0.03, 2.5
_SURE = 1e-12
HALF_WAVELENGTH_M = 0.35
_WAVES = 48


class Radio(NamedTuple):
    """Radio of a key and a Car: width of the transition from 90 to 10 %, share of fading fixed in space, share of
    random misses ("lapse")."""

    width_m: float
    share: float
    lapse: float


# 6 dB of fading and 2.2 dB of noise in time; one press in fifty fails at any distance.
FADING_SHARE, LAPSE = 0.88, 0.02


class Radial:
    """One radial; `place` determines its position and fading, `noise` the noise of each press.

    Attributes:
        mean_d50_m: distance at which half of the presses work, on the average over other fadings.
    """

    def __init__(self, radio: Radio, place: np.random.Generator, noise: np.random.Generator):
        self._radio = radio
        self._noise = noise
        self.mean_d50_m = float(place.uniform(8.0, 14.0))
        self._waves = math.pi / HALF_WAVELENGTH_M * place.uniform(-1.0, 1.0, _WAVES)
        self._phases = place.uniform(0.0, 2.0 * math.pi, _WAVES)

    @functools.cached_property
    def d50_m(self) -> float:
        """Distance at which half of the presses work, without random misses."""
        return self._distance_at(0.5)

    @functools.cached_property
    def d95_m(self) -> float:
        """Distance at which 95 % of the presses work; NaN if there is none."""
        return self._distance_at(0.95)

    def works(self, distance_m: float) -> float:
        """Return the probability that a press works at a distance, without random misses."""
        return float(self._works(np.array([distance_m]))[0])

    def press(self, distance_m: float) -> bool:
        """Return True if a press works."""
        radio = self._radio
        moment = float(self._noise.standard_normal())
        latent = math.sqrt(radio.share) * float(self._field(np.array([distance_m]))[0]) + math.sqrt(
            1.0 - radio.share) * moment
        works = float(self._mean(np.array([distance_m]))[0])
        return bool(ndtr(latent) < works) and float(self._noise.random()) >= radio.lapse

    def _distance_at(self, level: float) -> float:
        farthest_m = self.mean_d50_m + _WIDTHS_BEYOND * self._radio.width_m + 1.0
        distances_m = np.arange(_STEP_M, farthest_m, _STEP_M)
        return falls_below(distances_m, self._works(distances_m), level)

    def _works(self, distances_m: FloatArray) -> FloatArray:
        share, mean = self._radio.share, np.clip(self._mean(distances_m), _SURE, 1.0 - _SURE)
        result: FloatArray = ndtr((ndtri(mean) - math.sqrt(share) * self._field(distances_m)) / math.sqrt(1.0 - share))
        return result

    def _mean(self, distances_m: FloatArray) -> FloatArray:
        result: FloatArray = expit((self.mean_d50_m - distances_m) * WIDTH_PER_SCALE / self._radio.width_m)
        return result

    def _field(self, distances_m: FloatArray) -> FloatArray:
        waves = np.cos(np.multiply.outer(distances_m, self._waves) + self._phases)
        return np.asarray(math.sqrt(2.0 / _WAVES) * np.sum(waves, axis=-1))


class Polling(NamedTuple):
    """Polling of a Car's passive entry, and its bus."""

    poll_s: float = 0.3
    cycle_s: float = 0.2
    debounce: int = 2
    delay_s: float = 0.03
    threshold_noise_m: float = 0.012


def noticed_at(polling: Polling, speed_mps: float, noise: np.random.Generator) -> float:
    """Return how far beyond the static boundary the application sees the key at the event, m; includes 2 mm of pose
    noise."""
    time_s, agreeing = -0.5 / speed_mps - polling.poll_s * noise.random(), 0
    while agreeing < polling.debounce:
        time_s += polling.poll_s
        agreeing = agreeing + 1 if speed_mps * time_s > polling.threshold_noise_m * noise.standard_normal() else 0
    # The bus reports it up to a cycle later, and the application assumes the middle of the cycle.
    told_s = time_s + polling.delay_s + polling.cycle_s * (noise.random() - 0.5)
    return float(speed_mps * told_s + 0.002 * noise.standard_normal())
