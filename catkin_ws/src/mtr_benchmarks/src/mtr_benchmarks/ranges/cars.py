"""Cars of this benchmark: one radial of a transition with fading and lapses, one axis that is polled.

Written without the estimators' code, so that an error in one is not in the other. On a radial the probability p(d)
that a press works is logistic in the distance. Fading is a normal field along the radial, a sum of waves whose
correlation is sinc(2 pi r / wavelength); a press works when

    Phi(sqrt(share) * field(d) + sqrt(1 - share) * noise) < p(d),

which leaves p(d) as it is on the average over places.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, ndtr

WIDTH_PER_SCALE = 2.0 * math.log(9.0)
D95_PER_SCALE = math.log(19.0)
HALF_WAVELENGTH_M = 0.35
_WAVES = 48


class Radio(NamedTuple):
    """Of a key and a Car: width of the transition from 90 to 10 %, share of fading fixed in space, share of lapses."""

    width_m: float
    share: float
    lapse: float


# 6 dB of fading beside 2.2 dB of noise in time, and one press in fifty that fails anywhere.
FADING_SHARE, LAPSE = 0.88, 0.02


class Radial:
    """One radial; its place and fading come from `place`, the noise of each press from `noise`."""

    def __init__(self, radio: Radio, place: np.random.Generator, noise: np.random.Generator):
        self._radio = radio
        self._noise = noise
        self.d50_m = float(place.uniform(8.0, 14.0))
        self._waves = math.pi / HALF_WAVELENGTH_M * place.uniform(-1.0, 1.0, _WAVES)
        self._phases = place.uniform(0.0, 2.0 * math.pi, _WAVES)

    @property
    def d95_m(self) -> float:
        """Where 95 % of the presses work, lapses apart."""
        return self.d50_m - D95_PER_SCALE / WIDTH_PER_SCALE * self._radio.width_m

    def press(self, distance_m: float) -> bool:
        """True when it works."""
        radio = self._radio
        field = math.sqrt(2.0 / _WAVES) * float(np.sum(np.cos(self._waves * distance_m + self._phases)))
        moment = float(self._noise.standard_normal())
        latent = math.sqrt(radio.share) * field + math.sqrt(1.0 - radio.share) * moment
        works = float(expit((self.d50_m - distance_m) * WIDTH_PER_SCALE / radio.width_m))
        return bool(ndtr(latent) < works) and float(self._noise.random()) >= radio.lapse


class Polling(NamedTuple):
    """Of a Car's passive entry and its bus."""

    poll_s: float = 0.3
    cycle_s: float = 0.2
    debounce: int = 2
    delay_s: float = 0.03
    threshold_noise_m: float = 0.012


def noticed_at(polling: Polling, speed_mps: float, noise: np.random.Generator) -> float:
    """How far beyond the static boundary the application sees the key at the event, in m; 2 mm of it is the pose's."""
    time_s, agreeing = -0.5 / speed_mps - polling.poll_s * noise.random(), 0
    while agreeing < polling.debounce:
        time_s += polling.poll_s
        agreeing = agreeing + 1 if speed_mps * time_s > polling.threshold_noise_m * noise.standard_normal() else 0
    # The bus tells it up to a cycle later, and the application takes the middle of the cycle.
    told_s = time_s + polling.delay_s + polling.cycle_s * (noise.random() - 0.5)
    return float(speed_mps * told_s + 0.002 * noise.standard_normal())
