"""Places of a line that share no fading.

The correlation of the fading is sinc(2 pi r / wavelength), zero at half a wavelength and its multiples (Clarke's model,
isotropic scattering: R. Clarke, Bell System Technical Journal 47, 1968).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..interval import FloatArray

# A press that is nearer than this to the middle of a place, in half wavelengths, is taken as made there: 97 % of the
# variance of the fading are alike. Where places are all that is wanted each press is of its nearest one.
NEAR, NEAREST = 0.1, 0.5
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Lattice:
    """The middle of place number 0 lies at first_m, the next one half a wavelength, apart_m, farther; at_place: how far
    from it a press counts as made there, in half wavelengths."""

    first_m: float
    apart_m: float
    at_place: float = NEAR

    def place_of(self, distance_m: float) -> int:
        """Number of the place in whose half wavelength a distance lies."""
        return round((distance_m - self.first_m) / self.apart_m)

    def places_of(self, distances_m: FloatArray) -> npt.NDArray[np.int_]:
        """The same of many distances."""
        return np.asarray(np.rint((distances_m - self.first_m) / self.apart_m).astype(int))

    def places_within_m(self, low_m: float, high_m: float) -> FloatArray:
        """Middles of the places from one distance to another."""
        first, last = ((end_m - self.first_m) / self.apart_m for end_m in (low_m, high_m))
        return np.asarray(self.first_m + self.apart_m * np.arange(np.ceil(first - _ROUNDING), last + _ROUNDING))

    def is_between(self, distance_m: float) -> bool:
        """True where a press depends on the fading of several places."""
        where = (distance_m - self.first_m) / self.apart_m
        return abs(where - round(where)) > self.at_place

    def weights(self, distances_m: FloatArray, numbers: npt.NDArray[np.int_]) -> FloatArray:
        """Of the fading at places, by number, for that at distances; what other places would add is given to them."""
        weights = np.sinc((distances_m - self.first_m) / self.apart_m - numbers[:, None])
        return np.asarray(weights / np.sqrt(np.sum(weights ** 2, axis=0)))
