"""One attempt of the radio, as it happens: margin at the place, noise of the moment, and a lapse for no reason."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..noise import uniform_pair
from .margins import Margins
from .parameters import HonestParameters
from .passive_entry import Poll
from .radio.key_antenna import Attitude
from .radio.time_noise import TimeNoise

Point = Tuple[float, float, float]


class Attempts:
    """Draws what the Car receives; the same seed and course give the same."""

    def __init__(self, seed: int, parameters: HonestParameters):
        self._seed = seed
        self._noise = TimeNoise(seed, parameters.noise.sigma_db, parameters.noise.correlation_s)
        self._lapse = parameters.noise.lapse
        self._margins = Margins(parameters)
        self._number = 0

    def step(self, time_ns: int) -> None:
        """Let the noise go on."""
        self._noise.step(time_ns)

    def press(self, key_xyz: Point, attitude: Attitude) -> bool:
        """A press of a button is received."""
        return not self._lapses() and self._works(self._margins.button_db(np.array(key_xyz), attitude))

    def poll(self, key_xyz: Point, attitude: Attitude, extended_db: float = 0.0) -> Poll:
        """What a poll finds. extended_db: see Margins."""
        return self.judge_poll(*self._margins.polled_db(np.array(key_xyz), attitude, extended_db))

    def judge_poll(self, unlock_db: FloatArray, lock_db: FloatArray) -> Poll:
        """The same where the margins of the place are known."""
        if self._lapses() or not self._works(lock_db):
            return Poll.GONE
        return Poll.IN_UNLOCK_ZONE if self._works(unlock_db) else Poll.BETWEEN

    def _works(self, margin_db: FloatArray) -> bool:
        return bool(margin_db + self._noise.now_db >= 0.0)

    def _lapses(self) -> bool:
        self._number += 1
        return uniform_pair(self._seed, "lapse", self._number)[0] < self._lapse
