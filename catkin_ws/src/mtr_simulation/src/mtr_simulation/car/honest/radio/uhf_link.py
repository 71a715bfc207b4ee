"""Link from key to Receiver at several hundred MHz: received power above the Receiver's decoding threshold in dB.

    margin_dB = margin at 1 m - 20 log10(d) + two rays + key's antenna + battery + Car's pattern + fading(place)

d is the straight distance in m (Friis). Noise in time is added separately.
"""
# SPDX-License-Identifier: Apache-2.0
import numpy as np

from mtr_core.arrays import FloatArray

from ...parameters import RemoteParameters
from ..parameters import KeyParameters, UhfParameters
from .battery import battery_gain_db
from .key_antenna import LEVEL, Attitude, loop_axis, pattern_db
from .plane_waves import fading
from .two_ray import two_ray_gain_db, wavelength_m

_NEAREST_M = 0.2
# Pattern of the Car and place of its Receiver are equal to the gentle Car's.
_CAR = RemoteParameters()
_RECEIVER_M = np.array(_CAR.receiver_xyz_m)
_GAINS_DB, _ORDERS, _DIRECTIONS_RAD = np.array([(each.gain_db, each.order, each.direction_rad)
                                                for each in _CAR.lobes]).T


class UhfLink:
    """Link budget; places are arrays whose last axis is x, y, z in the Car's frame in m."""

    def __init__(self, place_seed: int, uhf: UhfParameters, key: KeyParameters):
        self._uhf = uhf
        self._key = key
        self._wave_m = wavelength_m(uhf.frequency_mhz)
        self._fading = fading(place_seed, "uhf", uhf.fading_sigma_db, self._wave_m)
        self._axis = loop_axis(key.axis_azimuth_deg, key.axis_elevation_deg)
        self._battery_db = battery_gain_db(key.battery_v, key.silent_below_v)

    def margin_db(self, places: FloatArray, attitude: Attitude = LEVEL) -> FloatArray:
        """Return the margin without the noise in time."""
        return self.mean_margin_db(places, attitude) + self._fading.at(places)

    def mean_margin_db(self, places: FloatArray, attitude: Attitude = LEVEL) -> FloatArray:
        """Return the margin without noise in time and fading."""
        uhf, key = self._uhf, self._key
        from_receiver = places - _RECEIVER_M
        x_m, y_m = from_receiver[..., 0], from_receiver[..., 1]
        ground_m = np.hypot(x_m, y_m)
        distance_m = np.maximum(np.hypot(ground_m, from_receiver[..., 2]), _NEAREST_M)
        rays_db = two_ray_gain_db(ground_m, (places[..., 2], _CAR.receiver_xyz_m[2]), self._wave_m,
                                  uhf.ground_permittivity)
        key_db = pattern_db(self._axis, attitude, -from_receiver, key.pattern_floor_db) + self._battery_db
        car_db = _car_pattern_db(np.arctan2(y_m, x_m))
        return uhf.margin_at_1m_db - 20.0 * np.log10(distance_m) + rays_db + key_db + car_db


def _car_pattern_db(azimuth_rad: FloatArray) -> FloatArray:
    """Return the Car's pattern: windscreen and rear window attenuate less than the doors."""
    return np.cos(_ORDERS * (azimuth_rad[..., None] - _DIRECTIONS_RAD)) @ _GAINS_DB
