"""Low-frequency field of the passive entry: magnetic dipoles in the near field, distorted by the bodywork.

    field_dB = strength + 10 log10(1 + 3 cos^2 theta) + lobe - 60 log10(d) + shadowing(place)

theta is the angle to the antenna's rod, d the distance in m. At 125 kHz (wavelength 2.4 km) all distances are in the
near field, without nulls and fading. The key measures with three coils, so that its attitude has no effect. Source:
Balanis 5.2; the antennas equal the gentle Car's.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Sequence

import numpy as np

from mtr_core.arrays import FloatArray

from ...parameters import LfAntenna
from .plane_waves import FieldSet, shadowing

_NEAREST_M = 0.2


class LfField:
    """Field of the strongest antenna at each place."""

    def __init__(self, place_seed: int, antennas: Sequence[LfAntenna], sigma_db: float, correlation_m: float):
        self._bent = FieldSet([shadowing(place_seed, antenna.name, sigma_db, correlation_m) for antenna in antennas])
        self._strength_db, self._lobe_db, self._lobe_rad, axis_rad, *self._middle_m = np.array(
            [(each.strength_db, each.lobe_db, each.lobe_rad, each.axis_rad, each.x_m, each.y_m, each.z_m)
             for each in antennas]).T
        self._rod = np.cos(axis_rad), np.sin(axis_rad)

    def strength_db(self, places: FloatArray) -> FloatArray:
        """Return the strength above the key's reference, without the noise in time; x, y, z in the last axis of
        places."""
        strongest: FloatArray = (self._dipoles_db(places) + self._bent.at(places)).max(axis=-1)
        return strongest

    def _dipoles_db(self, places: FloatArray) -> FloatArray:
        """Return the strength of each antenna alone, in the last axis."""
        x_m, y_m, z_m = (places[..., axis, None] - middle_m for axis, middle_m in enumerate(self._middle_m))
        squared = np.maximum(x_m * x_m + y_m * y_m + z_m * z_m, _NEAREST_M * _NEAREST_M)
        along = x_m * self._rod[0] + y_m * self._rod[1]
        lobe_db = self._lobe_db * np.cos(np.arctan2(y_m, x_m) - self._lobe_rad)
        # 30 times log10 of the squared distance equals 60 times log10 of the distance.
        return self._strength_db + 10.0 * np.log10(1.0 + 3.0 * along * along / squared) + lobe_db - 30.0 * np.log10(
            squared)
