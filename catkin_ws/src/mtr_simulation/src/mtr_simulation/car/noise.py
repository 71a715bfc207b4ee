"""Repeatable randomness: every value is a function of seed, name of the stream and index.

No generator has a state, so that the value at one place does not depend on the robot's previous path.
"""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import math
import struct
from typing import Tuple

_UINT64 = 2.0**64


def uniform_pair(seed: int, stream: str, index: int) -> Tuple[float, float]:
    """Return two independent numbers in [0, 1)."""
    digest = hashlib.blake2b(f"{seed}/{stream}/{index}".encode(), digest_size=16).digest()
    first, second = struct.unpack("<QQ", digest)
    return first / _UINT64, second / _UINT64


def gaussian(seed: int, stream: str, index: int) -> float:
    """Return a normally distributed number, mean 0, sigma 1."""
    first, second = uniform_pair(seed, stream, index)
    return math.sqrt(-2.0 * math.log(1.0 - first)) * math.cos(2.0 * math.pi * second)


class ShadowField:
    """Smooth random field over space in dB, as caused by reflections and bodywork.

    A sum of cosines with normally distributed wave vectors has approximately the correlation exp(-r^2 / (2 l^2)).
    """

    _WAVES = 24

    def __init__(self, seed: int, name: str, sigma_db: float, correlation_m: float):
        self._amplitude_db = sigma_db * math.sqrt(2.0 / self._WAVES)
        self._waves = [_wave(seed, f"shadow/{name}/{i}", correlation_m) for i in range(self._WAVES)]

    def at(self, x: float, y: float, z: float) -> float:
        """Return the gain in dB at a place in m."""
        cos = math.cos
        return self._amplitude_db * sum(cos(kx * x + ky * y + kz * z + p) for kx, ky, kz, p in self._waves)


def _wave(seed: int, stream: str, correlation_m: float) -> Tuple[float, float, float, float]:
    kx, ky, kz = (gaussian(seed, stream, axis) / correlation_m for axis in range(3))
    return kx, ky, kz, 2.0 * math.pi * uniform_pair(seed, stream, 3)[0]
