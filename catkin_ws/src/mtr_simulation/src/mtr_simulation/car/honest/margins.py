"""Margins in dB of the Car's decisions at a place above their thresholds, without the noise in time."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np

from mtr_core.arrays import FloatArray

from .parameters import HonestParameters
from .radio.key_antenna import Attitude
from .radio.lf_field import LfField
from .radio.uhf_link import UhfLink


class Margins:
    """Margins of one Car and key; places are arrays whose last axis is x, y, z in the Car's frame in m."""

    def __init__(self, parameters: HonestParameters):
        passive = parameters.passive_entry
        self._parameters = parameters
        self._uhf = UhfLink(parameters.place_seed, parameters.uhf, parameters.key)
        self._lf = LfField(parameters.place_seed, parameters.antennas, passive.shadow_sigma_db,
                           passive.shadow_correlation_m)

    def button_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the margin of a button press."""
        return self._uhf.margin_db(places, attitude) - self._parameters.key.button_needs_db

    def unlock_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the margin of a poll that finds the key in the unlock zone."""
        return np.minimum(self.field_db(places) - self.between_db, self.answer_db(places, attitude))

    def lock_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the margin of a poll that finds the key at all: field and answer must arrive; below 0 the key is
        gone."""
        return np.minimum(self.field_db(places), self.answer_db(places, attitude))

    def field_db(self, places: FloatArray) -> FloatArray:
        """Return the margin of the Car's field alone, which a key in the lock zone receives."""
        return self._lf.strength_db(places) - self._parameters.passive_entry.lock_threshold_db

    def answer_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Return the margin of the answer alone of a key that has received the field."""
        return self._uhf.margin_db(places, attitude)

    @property
    def between_db(self) -> float:
        """Difference of the field between the borders of the unlock zone and of the lock zone."""
        passive = self._parameters.passive_entry
        return passive.unlock_threshold_db - passive.lock_threshold_db
