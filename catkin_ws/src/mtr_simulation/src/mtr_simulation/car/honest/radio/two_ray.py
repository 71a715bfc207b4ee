"""Two-ray model: interference of the direct wave and the wave reflected by the ground.

    gain_dB = 20 log10 |1 + G exp(-j dphi)|,   dphi = 4 pi h_key h_receiver / (lambda d)

d is the distance in the ground plane in m. G is the reflection of a horizontally polarised wave (Fresnel), which is
negative for any dry ground and tends to -1 at grazing incidence:

    G = (sin psi - sqrt(eps - cos^2 psi)) / (sin psi + sqrt(eps - cos^2 psi)),   tan psi = (h_key + h_receiver) / d

Nulls are at d = 2 h_key h_receiver / (n lambda), n = 1, 2, ... With a key at 1.0 m and a Receiver at 1.15 m they are at
6.7 and 3.3 m for 868 MHz, and at 3.3 and 1.7 m for 434 MHz. Source: T. S. Rappaport, Wireless Communications, 2nd ed.,
4.6 (plane earth). The exact path difference would put the nulls nearer: 6.5 and 3.0 m, 3.0 and 1.0 m.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

import numpy as np

from mtr_core.arrays import FloatArray

SPEED_OF_LIGHT_MPS = 299_792_458.0
# Smallest distance: the plane-earth phase grows without bound towards the antenna, where the direct wave dominates.
_NEAREST_M = 0.5


def wavelength_m(frequency_mhz: float) -> float:
    """Return the wavelength in air."""
    return SPEED_OF_LIGHT_MPS / (frequency_mhz * 1e6)


def two_ray_gain_db(ground_m: FloatArray, heights_m: Tuple[FloatArray, float], wave_m: float,
                    permittivity: float) -> FloatArray:
    """Return the gain over free space at distances in the ground plane. heights_m: heights of key and Receiver."""
    key_m, receiver_m = heights_m
    distance_m = np.maximum(ground_m, _NEAREST_M)
    phase_rad = 4.0 * math.pi * key_m * receiver_m / (wave_m * distance_m)
    reflected = reflection(np.arctan2(key_m + receiver_m, distance_m), permittivity)
    return 20.0 * np.log10(np.hypot(1.0 + reflected * np.cos(phase_rad), reflected * np.sin(phase_rad)))


def reflection(grazing_rad: FloatArray, permittivity: float) -> FloatArray:
    """Return Fresnel's coefficient for horizontal polarisation; grazing_rad is the angle between wave and ground."""
    sine = np.sin(grazing_rad)
    root = np.sqrt(permittivity - np.cos(grazing_rad) ** 2)
    return (sine - root) / (sine + root)
