"""Random field in space, in dB, that is constant in time: effects of reflections, bodywork and neighbours at each
place.

    f(r) = sigma sqrt(2 / N) sum_i cos(k_i . r + phi_i),   N waves, phi_i uniform

The value at each place is nearly normally distributed with the given sigma. Only N waves are stored, whatever the size
of the site. The wave vectors determine the correlation:

- uniform directions, |k| = 2 pi / lambda: sin(k r) / (k r), which is 0 at half a wavelength. Plane waves from all
  directions have it (Clarke 1968, Bell Syst. Tech. J. 47; in three dimensions Cook et al. 1955, J. Acoust. Soc. Am.).
- normally distributed with 1 / l in each direction: exp(-r^2 / (2 l^2)).

In dB the field is log-normal: 5 to 8 dB next to a car outdoors (ITU-R P.1411, Rappaport 4.9).
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import Sequence

import numpy as np

from mtr_core.arrays import FloatArray

from ...noise import gaussian, uniform_pair

WAVES = 96


class PlaneWaves:
    """One field; places are arrays whose last axis is x, y, z in m."""

    def __init__(self, sigma_db: float, vectors: FloatArray, phases: FloatArray):
        self.amplitude_db = sigma_db * math.sqrt(2.0 / len(vectors))
        self.vectors = vectors
        self.phases = phases

    def at(self, places: FloatArray) -> FloatArray:
        """Return the gain in dB."""
        if self.amplitude_db == 0.0:
            return np.zeros(places.shape[:-1])
        return self.amplitude_db * _cosines(places, self.vectors, self.phases).sum(axis=-1)


class FieldSet:
    """Several fields that are evaluated at the same places, each of WAVES waves."""

    def __init__(self, fields: Sequence[PlaneWaves]):
        self._amplitudes_db = np.array([field.amplitude_db for field in fields])
        self._vectors = np.concatenate([field.vectors for field in fields])
        self._phases = np.concatenate([field.phases for field in fields])
        self._is_flat = not self._amplitudes_db.any()

    def at(self, places: FloatArray) -> FloatArray:
        """Return the gains in dB; the last axis is the field."""
        shape = (*places.shape[:-1], len(self._amplitudes_db))
        if self._is_flat:
            return np.zeros(shape)
        waves = _cosines(places, self._vectors, self._phases)
        return self._amplitudes_db * waves.reshape((*shape, WAVES)).sum(axis=-1)


def _cosines(places: FloatArray, vectors: FloatArray, phases: FloatArray) -> FloatArray:
    """Return the cosine of each wave at each place. Three products are faster than the matrix product of a plain
    BLAS."""
    angles = places[..., 0, None] * vectors[:, 0]
    angles += places[..., 1, None] * vectors[:, 1]
    angles += places[..., 2, None] * vectors[:, 2]
    angles += phases
    cosines: FloatArray = np.cos(angles, out=angles)
    return cosines


@functools.lru_cache(maxsize=64)
def fading(seed: int, name: str, sigma_db: float, wave_m: float) -> PlaneWaves:
    """Return a field of waves from all directions; uncorrelated over half a wavelength."""
    directions = np.array([_direction(seed, f"fading/{name}/{i}", i) for i in range(WAVES)])
    return PlaneWaves(sigma_db, 2.0 * math.pi / wave_m * directions, _phases(seed, f"fading/{name}"))


@functools.lru_cache(maxsize=64)
def shadowing(seed: int, name: str, sigma_db: float, correlation_m: float) -> PlaneWaves:
    """Return a smooth field; correlated by exp(-1/2) over correlation_m."""
    vectors = np.array([[gaussian(seed, f"shadowing/{name}/{i}", axis) for axis in range(3)] for i in range(WAVES)])
    return PlaneWaves(sigma_db, vectors / correlation_m, _phases(seed, f"shadowing/{name}"))


def _direction(seed: int, stream: str, number: int) -> FloatArray:
    """Return a unit vector; the heights are drawn in strata, so that all directions are covered."""
    first, second = uniform_pair(seed, stream, 0)
    height = 2.0 * (number + first) / WAVES - 1.0
    across = math.sqrt(1.0 - height * height)
    angle = 2.0 * math.pi * second
    return np.array([across * math.cos(angle), across * math.sin(angle), height])


def _phases(seed: int, stream: str) -> FloatArray:
    return np.array([2.0 * math.pi * uniform_pair(seed, f"{stream}/phase", i)[0] for i in range(WAVES)])
