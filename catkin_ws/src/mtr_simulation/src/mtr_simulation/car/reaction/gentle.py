"""Probabilities of the gentle Car's reactions: an almost ideal threshold, with uncorrelated noise at every poll."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable

import numpy as np

from mtr_core.arrays import FloatArray

from ..honest.radio.key_antenna import Attitude
from ..parameters import CarParameters
from ..radio import PassiveEntryRadio, Point, RemoteRadio
from .debounced import Polling, finds_probability, loses_probability, single_probability

# Response time: the gentle Car polls every 0.1 s, so it has reacted by then or never will.
RESPONSE_S = 3.0


class GentleReactions:
    """See ReactionModel; the attitude has no effect on this Car."""

    def __init__(self, seed: int, parameters: CarParameters):
        self._passive_parameters = passive = parameters.passive_entry
        self._remote_sigma_db = parameters.remote.noise_sigma_db
        self._passive = PassiveEntryRadio(seed, passive, parameters.shadow_correlation_m)
        self._remote = RemoteRadio(seed, parameters.remote, parameters.shadow_correlation_m)
        self._polling = Polling(RESPONSE_S * 1000.0 / passive.poll_period_ms, passive.debounce_polls, 0.0, 0.0)

    def press(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return single_probability(_at_each(places, self._remote.margin_db), self._remote_sigma_db)

    def unlock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return finds_probability(self._unlock_db(places), self._passive_parameters.noise_sigma_db, self._polling)

    def lock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return loses_probability(self._lock_db(places), self._passive_parameters.noise_sigma_db, self._polling)

    def handle(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel; this Car has no sensor at its handle."""
        return np.zeros(places.shape[:-1])

    def unlock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return single_probability(self._unlock_db(places), self._passive_parameters.noise_sigma_db)

    def lock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return 1.0 - single_probability(self._lock_db(places), self._passive_parameters.noise_sigma_db)

    def _unlock_db(self, places: FloatArray) -> FloatArray:
        return _at_each(places, self._passive.strength_db) - self._passive_parameters.unlock_threshold_db

    def _lock_db(self, places: FloatArray) -> FloatArray:
        return _at_each(places, self._passive.strength_db) - self._passive_parameters.lock_threshold_db


def _at_each(places: FloatArray, function: Callable[[Point], float]) -> FloatArray:
    rows = places.reshape(-1, 3).tolist()
    return np.array([function((x, y, z)) for x, y, z in rows]).reshape(places.shape[:-1])
