"""What a Car's truth can be asked: the probability of each reaction, place by place."""
# SPDX-License-Identifier: Apache-2.0
from typing import Protocol

from mtr_core.arrays import FloatArray

from ..honest.radio.key_antenna import Attitude


class ReactionModel(Protocol):
    """Probabilities at places, given as arrays whose last axis is x, y, z in the true Car frame in m.

    Of an unlocked Car for lock, of a locked one for the others; the key stands still, is awake and comes from outside
    of the zone (for lock: from within). A reaction counts when the Car decides within its response time.
    """

    def press(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """One press of a button works."""

    def unlock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Passive entry unlocks."""

    def lock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Passive entry locks."""

    def handle(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """One handle request finds the key in the unlock zone."""

    def unlock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """A single poll finds the key in the unlock zone, lapses left out: 50 % is the static boundary."""

    def lock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """A single poll no longer finds the key, lapses left out: 50 % is the static boundary."""
