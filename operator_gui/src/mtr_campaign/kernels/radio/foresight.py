"""The radio's margins at the Car's next polls, many at once: where the key will be if it goes straight on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from typing import Callable

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_simulation.car.honest.instants import HonestInstants
from mtr_simulation.car.honest.radio.key_antenna import Attitude

from .carried_key import NS, CarriedKey
from .errors import Point

# So many polls are looked at once the key has turned, and so many times as many each time as long as it goes straight
# on: a look costs as much as some ten places in it, and a key that has gone straight for two polls mostly goes on.
_FEWEST, _MORE, _MOST = 2, 8, 128
# So far from where it was expected the margin of the radio is another one; fading changes within decimetres.
_SAME_PLACE_M = 1e-3
_SAME_HEADING_RAD = 1e-3


class Foresight:
    """Of one test. heading_rad: by how much the robot is wrong about its heading."""

    def __init__(self, car: HonestInstants, heading_rad: float):
        self._car = car
        self._heading_rad = heading_rad
        self._count = _FEWEST
        self._numbers: dict[int, int] = {}
        self._places: FloatArray = np.empty((0, 3))
        self._expected: list[list[float]] = []
        self._heading = 0.0
        self._field_db: list[float] = []
        self._answer_db: list[float] = []

    def margins_db(self, time_ns: int, place: Point, key: CarriedKey) -> tuple[float, Callable[[], float]]:
        """Of the field and of the answer at a poll in the last ticks, see Margins."""
        number = self._numbers.get(time_ns)
        if number is None or math.dist(self._expected[number], place) > _SAME_PLACE_M or abs(
                self._heading - key.heading) > _SAME_HEADING_RAD:
            self._count = min(_MORE * self._count, _MOST) if number is None else _FEWEST
            self._look(time_ns, place, key)
            number = 0
        return self._field_db[number], functools.partial(self._answer, number)

    def _look(self, time_ns: int, place: Point, key: CarriedKey) -> None:
        times_ns = [time_ns, *self._car.next_polls_ns(time_ns, self._count - 1)]
        self._numbers = {each: number for number, each in enumerate(times_ns)}
        seconds = (np.array(times_ns) - time_ns) / NS
        self._places = np.array(place) + seconds[:, None] * key.velocity_mps
        self._expected, self._heading = self._places.tolist(), key.heading
        self._field_db, self._answer_db = self._car.margins.field_db(self._places).tolist(), []

    def _answer(self, number: int) -> float:
        """Of a key that has heard the field, which on most of a way it does not."""
        if not self._answer_db:
            attitude = Attitude(self._heading - self._heading_rad)
            self._answer_db = self._car.margins.answer_db(self._places, attitude).tolist()
        return self._answer_db[number]
