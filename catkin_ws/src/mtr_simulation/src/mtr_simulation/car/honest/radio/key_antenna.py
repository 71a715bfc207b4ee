"""Pattern of the key's antenna: a small loop with a null along its axis, rotated by the key's attitude.

    gain_dB = 10 log10(f + (1 - f) sin^2 theta)

theta is the angle between the loop's axis and the direction to the Receiver. f, the floor, is the additional radiation
of case, hand and battery. Source: C. Balanis, Antenna Theory, 5.2 (small loop); floors of fobs are -10 to -15 dB.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple

import numpy as np

from mtr_core.arrays import FloatArray


class Attitude(NamedTuple):
    """Rotation of the key relative to the Car's frame: about z, then y, then x (REP 103), in rad."""

    yaw_rad: float = 0.0
    pitch_rad: float = 0.0
    roll_rad: float = 0.0

    def turned(self, vector: FloatArray) -> FloatArray:
        """Return a vector of the key's frame in the Car's frame."""
        cy, sy = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        cp, sp = math.cos(self.pitch_rad), math.sin(self.pitch_rad)
        cr, sr = math.cos(self.roll_rad), math.sin(self.roll_rad)
        car_from_key = np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                                 [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                                 [-sp, cp * sr, cp * cr]])
        return car_from_key @ vector


LEVEL = Attitude()


def loop_axis(azimuth_deg: float, elevation_deg: float) -> FloatArray:
    """Return the unit vector of the loop's axis in the key's frame."""
    azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
    return np.array([math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth),
                     math.sin(elevation)])


def pattern_db(axis: FloatArray, attitude: Attitude, to_receiver: FloatArray, floor_db: float) -> FloatArray:
    """Return the gain in each direction; to_receiver need not have unit length."""
    along = to_receiver @ attitude.turned(axis) / np.maximum(np.linalg.norm(to_receiver, axis=-1), 1e-9)
    floor = 10.0 ** (floor_db / 10.0)
    return 10.0 * np.log10(floor + (1.0 - floor) * (1.0 - np.minimum(along * along, 1.0)))
