"""Probabilities of the honest Car's reactions."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

from mtr_core.arrays import FloatArray

from ..honest.margins import Margins
from ..honest.parameters import HonestParameters
from ..honest.radio.key_antenna import Attitude
from .debounced import Polling, finds_probability, loses_probability, single_probability


class HonestReactions:
    """See ReactionModel; for an undisturbed Car, without its relock timer."""

    def __init__(self, parameters: HonestParameters):
        self._parameters = parameters
        self._margins = Margins(parameters)

    def press(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        noise = self._parameters.noise
        return single_probability(self._margins.button_db(places, attitude), noise.sigma_db, noise.lapse)

    def unlock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel; for Cars that unlock only by the handle, the probability of one handle request."""
        noise, passive = self._parameters.noise, self._parameters.passive_entry
        if not passive.enabled:
            return np.zeros(places.shape[:-1])
        if passive.unlock_on == "handle":
            return self.handle(places, attitude)
        return finds_probability(self._margins.unlock_db(places, attitude), noise.sigma_db, self._polling())

    def handle(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        noise = self._parameters.noise
        if not self._parameters.passive_entry.enabled:
            return np.zeros(places.shape[:-1])
        return single_probability(self._margins.unlock_db(places, attitude), noise.sigma_db, noise.lapse)

    def lock(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel; a delay of the walk-away lock adds to the response time."""
        passive = self._parameters.passive_entry
        if not passive.enabled or passive.walk_away == "off" or self._parameters.locks.second_key_inside:
            return np.zeros(places.shape[:-1])
        return loses_probability(self._leaving_db(places, attitude), self._parameters.noise.sigma_db, self._polling())

    def unlock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return single_probability(self._margins.unlock_db(places, attitude), self._parameters.noise.sigma_db)

    def lock_poll(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """See ReactionModel."""
        return 1.0 - single_probability(self._leaving_db(places, attitude), self._parameters.noise.sigma_db)

    def _leaving_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        by_distance = self._parameters.passive_entry.walk_away == "distance"
        return self._margins.lock_db(places, attitude) if by_distance else self._margins.unlock_db(places, attitude)

    def _polling(self) -> Polling:
        passive, noise = self._parameters.passive_entry, self._parameters.noise
        period_s = passive.poll_period_ms * 1e-3
        return Polling(passive.response_s / period_s, passive.debounce_polls,
                       math.exp(-period_s / noise.correlation_s), noise.lapse)
