"""One attempt of the radio: margin at the place, noise at the time, and random misses ("lapses")."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Tuple

import numpy as np

from ..noise import uniform_pair
from .margins import Margins
from .parameters import HonestParameters
from .passive_entry import Poll
from .radio.key_antenna import Attitude
from .radio.time_noise import TimeNoise

Point = Tuple[float, float, float]


class Attempts:
    """Draws the success of attempts; the same seed and motion give the same results."""

    def __init__(self, seed: int, parameters: HonestParameters):
        self._seed = seed
        self._noise = TimeNoise(seed, parameters.noise.sigma_db, parameters.noise.correlation_s)
        self._lapse = parameters.noise.lapse
        self._margins = Margins(parameters)
        self._number = 0

    def step(self, time_ns: int) -> None:
        """Advance the noise."""
        self._noise.step(time_ns)

    def press(self, key_xyz: Point, attitude: Attitude) -> bool:
        """Return True if a press of a button is received."""
        return not self._lapses() and self._works(float(self._margins.button_db(np.array(key_xyz), attitude)))

    def poll(self, key_xyz: Point, attitude: Attitude, extended_db: float = 0.0) -> Poll:
        """Return the result of a poll. extended_db: gain of an extender on the field at the key."""
        place = np.array(key_xyz)
        return self.judge_poll(float(self._margins.field_db(place)) + extended_db,
                               lambda: float(self._margins.answer_db(place, attitude)))

    def judge_poll(self, field_db: float, answer_db: Callable[[], float]) -> Poll:
        """Return the result of a poll with a known margin of the field; the answer's margin is computed only if
        necessary."""
        if self._lapses() or not (self._works(field_db) and self._works(answer_db())):
            return Poll.GONE
        return Poll.IN_UNLOCK_ZONE if self._works(field_db - self._margins.between_db) else Poll.BETWEEN

    def _works(self, margin_db: float) -> bool:
        return margin_db + self._noise.now_db >= 0.0

    def _lapses(self) -> bool:
        self._number += 1
        if self._lapse == 0.0:
            return False
        return uniform_pair(self._seed, "lapse", self._number)[0] < self._lapse
