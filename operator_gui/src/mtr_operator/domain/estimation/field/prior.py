"""Prior of a Car's field: a latent height, whose logistic is the share of successful presses.

    latent(place) = slope * (gap - range) + shape(place) + fading(place)

gap: distance of the key from the Car's outline. The range lies within the map or slightly beyond its ends. The shape
(antennas, body) varies over metres, the fading over a quarter of the wavelength. All are normal, so the latent heights
of any places are a normal vector: a Gaussian process.

The slope of the share and its part of fading differ between Cars by more than a factor of ten; with one common slope,
the intervals of a Car with a small slope are too narrow. There is therefore a Gaussian process for each point of a grid
of slopes and fadings, weighted by the presses (latent_field). The field of a radio is the same at all distances except
for its scale: range, its spread, shape and widths scale with the size of the map.

Sources: Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), 2.7 and 5.2; Jakes, Microwave Mobile
Communications (1974), for the length of the fading.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from ..interval import FloatArray

# Widths from 90 to 10 % of the presses, relative to the range in the middle of the map.
WIDTH_SHARES = (0.12, 0.25, 0.5, 1.0, 2.0)
# Standard deviations in units of the logistic, and their probabilities: 5 to 8 dB of fading with 1 to 3 dB of noise in
# time give 3 to 13. Presses hardly determine it, and an underestimate makes the intervals too narrow.
FADINGS, FADING_PRIOR = (0.5, 1.0, 2.0, 4.0, 8.0), (0.1, 0.1, 0.2, 0.3, 0.3)
_WIDTH_PER_SCALE = 2.0 * math.log(9.0)
# Standard deviation of the range relative to half of the map's depth; of the slope relative to its grid, whose steps it
# bridges.
_SPREAD_SHARE, _SLOPE_SHARE = 0.8, 0.25
# Variation of the range with the direction, relative to the range in the middle of the map.
_SHAPE_SHARE = 0.2
_SHAPE_LENGTH_M, _HEIGHT_LENGTH_M = 2.5, 0.5
# Two places half a wavelength apart are uncorrelated.
_LENGTHS_PER_HALF_WAVE = 0.5


@dataclass(frozen=True)
class FieldPrior:
    """Prior on places. Places are rows of x, y, height above ground and gap, in m; the first axis of arrays is the
    grid's.

    Attributes:
        half_wavelength_m: 0.35 at 434 MHz.
        nearest_m, farthest_m: gaps of the map's places.
        grid: rows of width from 90 to 10 %, relative to the range in the middle of the map, fading, and probability.
    """

    half_wavelength_m: float = 0.35
    nearest_m: float = 0.5
    farthest_m: float = 6.0
    grid: FloatArray = field(default_factory=lambda: np.array([
        (width, fading, likely / len(WIDTH_SHARES)) for width in WIDTH_SHARES
        for fading, likely in zip(FADINGS, FADING_PRIOR)]))

    def only(self, rows: npt.NDArray[np.int_]) -> FieldPrior:
        """Return the prior with some rows of the grid."""
        return FieldPrior(self.half_wavelength_m, self.nearest_m, self.farthest_m, self.grid[rows])

    @property
    def range_m(self) -> float:
        """Expected gap at which half of the presses work."""
        return (self.nearest_m + self.farthest_m) / 2.0

    @property
    def slope_per_m(self) -> FloatArray:
        """Slope of each row of the grid."""
        return np.asarray(-_WIDTH_PER_SCALE / (self.grid[:, 0] * self.range_m))

    def mean(self, places: FloatArray) -> FloatArray:
        """Return the mean of the latent heights."""
        return np.asarray(self.slope_per_m[:, None] * (places[:, 3] - self.range_m))

    def smooth(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the covariance of the latent heights at two sets of places without fading, which neighbours have in
        common."""
        across = np.sum((first[:, None, :2] - second[None, :, :2]) ** 2, axis=-1)
        up = (first[:, None, 2] - second[None, :, 2]) ** 2
        alike = np.exp(-0.5 * (across / _SHAPE_LENGTH_M ** 2 + up / _HEIGHT_LENGTH_M ** 2))
        tilt = (first[:, None, 3] - self.range_m) * (second[None, :, 3] - self.range_m)
        return np.asarray(self.slope_per_m[:, None, None] ** 2 * self._moved(tilt, alike))

    def fading(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the covariance of the fading at two sets of places; both covariances are added."""
        across = np.sum((first[:, None, :3] - second[None, :, :3]) ** 2, axis=-1)
        length_m = _LENGTHS_PER_HALF_WAVE * self.half_wavelength_m
        return np.asarray(self.grid[:, 1, None, None] ** 2 * np.exp(-0.5 * across / length_m ** 2))

    def variances(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the variances of the latent heights at places, without fading and with it."""
        tilt = (places[:, 3] - self.range_m) ** 2
        smooth = self.slope_per_m[:, None] ** 2 * self._moved(tilt, np.ones(len(places)))
        return smooth, smooth + self.grid[:, 1, None] ** 2

    def _moved(self, tilt: FloatArray, alike: FloatArray) -> FloatArray:
        """Return the covariance of the boundary's displacement, in m2: by the range, by its own slope, and by the
        shape."""
        spread_m = _SPREAD_SHARE * (self.farthest_m - self.nearest_m) / 2.0
        return np.asarray(spread_m ** 2 + _SLOPE_SHARE ** 2 * tilt + (_SHAPE_SHARE * self.range_m) ** 2 * alike)
