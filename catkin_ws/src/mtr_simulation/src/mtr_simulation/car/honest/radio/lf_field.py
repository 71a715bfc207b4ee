"""The low-frequency field of the passive entry: magnetic dipoles in the near field, bent by the bodywork.

    field_dB = strength + 10 log10(1 + 3 cos^2 theta) + lobe - 60 log10(d) + shadowing(place)

theta is the angle to the antenna's rod, d the distance in m: at 125 kHz (wavelength 2.4 km) everything is near field,
so there are no nulls and no fading. The key measures with three coils, so that its attitude does not matter. Source:
Balanis 5.2; antennas as the gentle Car has them.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Sequence

import numpy as np

from mtr_core.arrays import FloatArray

from ...parameters import LfAntenna
from .plane_waves import shadowing

_NEAREST_M = 0.2


class LfField:
    """The strongest antenna at each place."""

    def __init__(self, place_seed: int, antennas: Sequence[LfAntenna], sigma_db: float, correlation_m: float):
        self._paths = [(antenna, shadowing(place_seed, antenna.name, sigma_db, correlation_m)) for antenna in antennas]

    def strength_db(self, places: FloatArray) -> FloatArray:
        """Over the key's reference, without the noise in time; places as x, y, z in the last axis."""
        return np.max([dipole_db(antenna, places) + bent.at(places) for antenna, bent in self._paths], axis=0)


def dipole_db(antenna: LfAntenna, places: FloatArray) -> FloatArray:
    """One antenna alone."""
    offsets = places - np.array([antenna.x_m, antenna.y_m, antenna.z_m])
    distance_m = np.maximum(np.linalg.norm(offsets, axis=-1), _NEAREST_M)
    rod = np.array([np.cos(antenna.axis_rad), np.sin(antenna.axis_rad), 0.0])
    along = offsets @ rod / distance_m
    lobe_db = antenna.lobe_db * np.cos(np.arctan2(offsets[..., 1], offsets[..., 0]) - antenna.lobe_rad)
    return antenna.strength_db + 10.0 * np.log10(1.0 + 3.0 * along * along) + lobe_db - 60.0 * np.log10(distance_m)
