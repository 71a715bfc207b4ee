"""Prefetch of radio margins at the next polls of the Car, for a key that continues straight."""
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

# Number of polls in the first batch after a turn, growth factor while the key moves straight, and largest batch. A
# batch costs as much as about ten of its places, and a key that was straight for two polls mostly continues straight.
_FEWEST, _MORE, _MOST = 2, 8, 128
# At a larger deviation from the predicted place, the margins are computed again: fading changes within decimetres.
_SAME_PLACE_M = 1e-3
_SAME_HEADING_RAD = 1e-3


class MarginForecast:
    """Prefetched margins of one test. heading_rad: heading error of the robot."""

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
        """Return the field margin at a poll in the last ticks, and a function for the answer margin; see Margins."""
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
        """Return the margin of the answer; computed on demand, because most polls do not wake the key."""
        if not self._answer_db:
            attitude = Attitude(self._heading - self._heading_rad)
            self._answer_db = self._car.margins.answer_db(self._places, attitude).tolist()
        return self._answer_db[number]
