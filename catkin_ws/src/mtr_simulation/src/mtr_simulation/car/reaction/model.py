"""Interface of a Car's truth: the probability of each reaction at each place."""
# SPDX-License-Identifier: Apache-2.0
from typing import Protocol

from mtr_core.arrays import FloatArray

from ..honest.radio.key_antenna import Attitude


class ReactionModel(Protocol):
    """Probabilities at places, given as arrays whose last axis is x, y, z in the true Car frame in m.

    The Car is unlocked for lock, and locked for the others. The key is at rest, is awake and comes from outside of the
    zone (for lock: from inside). A reaction counts if the Car decides within its response time.
    """

    def press(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that one press of a button works."""

    def unlock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that passive entry unlocks."""

    def lock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that passive entry locks."""

    def handle(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that one handle request finds the key in the unlock zone."""

    def unlock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that one poll finds the key in the unlock zone, without random misses: 50 % at the
        static boundary."""

    def lock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the probability that one poll no longer finds the key, without random misses: 50 % at the static
        boundary."""
