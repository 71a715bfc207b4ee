"""One attempt of the radio, as it happens: margin at the place, noise of the moment, and a lapse for no reason."""
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
        return not self._lapses() and self._works(float(self._margins.button_db(np.array(key_xyz), attitude)))

    def poll(self, key_xyz: Point, attitude: Attitude, extended_db: float = 0.0) -> Poll:
        """What a poll finds. extended_db: what an extender adds to the field that comes to the key."""
        place = np.array(key_xyz)
        return self.judge_poll(float(self._margins.field_db(place)) + extended_db,
                               lambda: float(self._margins.answer_db(place, attitude)))

    def judge_poll(self, field_db: float, answer_db: Callable[[], float]) -> Poll:
        """The same where the field's margin at the place is known; that of the answer is asked for where it counts."""
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
