"""By how many dB each of the Car's decisions at a place is clear of its threshold, before the noise in time."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from .parameters import HonestParameters
from .radio.key_antenna import Attitude
from .radio.lf_field import LfField
from .radio.uhf_link import UhfLink


class Margins:
    """Of one Car and key; places are arrays whose last axis is x, y, z in the Car's frame in m."""

    def __init__(self, parameters: HonestParameters):
        passive = parameters.passive_entry
        self._parameters = parameters
        self._uhf = UhfLink(parameters.place_seed, parameters.uhf, parameters.key)
        self._lf = LfField(parameters.place_seed, parameters.antennas, passive.shadow_sigma_db,
                           passive.shadow_correlation_m)

    def button_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Of a press of a button."""
        return self._uhf.margin_db(places, attitude) - self._parameters.key.button_needs_db

    def unlock_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Of a poll that finds the key in the unlock zone."""
        return self.polled_db(places, attitude)[0]

    def lock_db(self, places: FloatArray, attitude: Attitude) -> FloatArray:
        """Of a poll that finds the key at all; below 0 it is gone."""
        return self.polled_db(places, attitude)[1]

    def polled_db(self, places: FloatArray, attitude: Attitude, extended_db: float = 0.0
                  ) -> Tuple[FloatArray, FloatArray]:
        """Both of the former. extended_db: what an extender adds to the field that comes to the key."""
        passive = self._parameters.passive_entry
        field_db, answer_db = self._lf.strength_db(places) + extended_db, self._uhf.margin_db(places, attitude)
        # Both ways have to work: the Car's field to the key, and the key's answer to the Receiver.
        return (np.minimum(field_db - passive.unlock_threshold_db, answer_db),
                np.minimum(field_db - passive.lock_threshold_db, answer_db))
