"""What is taken of a Car's field before it is measured: a latent height, whose logistic is the share that works.

    latent(place) = level + slope * (gap - 3 m) + shape(place) + fading(place)

gap: distance of the key from the Car's outline. The level is nearly free, the share falls from 90 to 10 % within some
metres, the shape (antennas, body) varies over metres and the fading over a quarter of the wavelength. All are normal,
so that the latent heights of any places are a normal vector: a Gaussian process with this covariance. Sources:
Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), 2.7 and 4.2; Jakes, Microwave Mobile
Communications (1974), for the length of the fading.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..interval import FloatArray

# Standard deviations of level, slope around its mean, and shape, in units of the logistic.
_LEVEL, _SLOPE_PER_M, _SHAPE = 4.0, 0.8, 1.2
# 90 to 10 % within 2.2 m.
_MEAN_SLOPE_PER_M = -2.0
# Gap at which half of the presses work; the level leaves it some metres to either side.
_MEAN_RANGE_M = 3.0
_SHAPE_LENGTH_M, _HEIGHT_LENGTH_M = 2.5, 0.5
_FADING = 1.2
# Half a wavelength apart two places have nothing in common any more.
_LENGTHS_PER_HALF_WAVE = 0.5


@dataclass(frozen=True)
class FieldPrior:
    """Attributes: half_wavelength_m: 0.35 at 434 MHz. Places are rows of x, y, height above ground and gap, in m."""

    half_wavelength_m: float = 0.35

    def mean(self, places: FloatArray) -> FloatArray:
        """Of the latent heights."""
        return np.asarray(_MEAN_SLOPE_PER_M * (places[:, 3] - _MEAN_RANGE_M))

    def covariance(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Between the latent heights at two sets of places."""
        across = np.sum((first[:, None, :3] - second[None, :, :3]) ** 2, axis=-1)
        length_m = _LENGTHS_PER_HALF_WAVE * self.half_wavelength_m
        return np.asarray(self.smooth(first, second) + _FADING ** 2 * np.exp(-0.5 * across / length_m ** 2))

    def smooth(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """The same without fading: what neighbouring places have in common."""
        across = np.sum((first[:, None, :2] - second[None, :, :2]) ** 2, axis=-1)
        up = (first[:, None, 2] - second[None, :, 2]) ** 2
        slope = _SLOPE_PER_M ** 2 * (first[:, None, 3] - _MEAN_RANGE_M) * (second[None, :, 3] - _MEAN_RANGE_M)
        shape = _SHAPE ** 2 * np.exp(-0.5 * (across / _SHAPE_LENGTH_M ** 2 + up / _HEIGHT_LENGTH_M ** 2))
        return np.asarray(_LEVEL ** 2 + slope + shape)
