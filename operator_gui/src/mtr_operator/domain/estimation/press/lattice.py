"""Places of a line with independent fading.

The correlation of the fading is sinc(2 pi r / wavelength), zero at half a wavelength and its multiples (Clarke's model,
isotropic scattering: R. Clarke, Bell System Technical Journal 47, 1968).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..interval import FloatArray

# A press closer than this to the centre of a place, in half wavelengths, counts as made there: 97 % of the fading's
# variance is common. If a coarse result suffices, each press belongs to its nearest place.
NEAR, NEAREST = 0.1, 0.5
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Lattice:
    """Places at intervals of half a wavelength, apart_m. first_m: centre of place number 0. at_place: distance from a
    centre, in half wavelengths, within which a press counts as made there."""

    first_m: float
    apart_m: float
    at_place: float = NEAR

    def place_of(self, distance_m: float) -> int:
        """Return the number of the place that contains a distance."""
        return round((distance_m - self.first_m) / self.apart_m)

    def places_of(self, distances_m: FloatArray) -> npt.NDArray[np.int_]:
        """Return the numbers for many distances."""
        return np.asarray(np.rint((distances_m - self.first_m) / self.apart_m).astype(int))

    def places_within_m(self, low_m: float, high_m: float) -> FloatArray:
        """Return the centres of the places between two distances."""
        first, last = ((end_m - self.first_m) / self.apart_m for end_m in (low_m, high_m))
        return np.asarray(self.first_m + self.apart_m * np.arange(np.ceil(first - _ROUNDING), last + _ROUNDING))

    def is_between(self, distance_m: float) -> bool:
        """Return True if a press depends on the fading of several places."""
        where = (distance_m - self.first_m) / self.apart_m
        return abs(where - round(where)) > self.at_place

    def weights(self, distances_m: FloatArray, numbers: npt.NDArray[np.int_]) -> FloatArray:
        """Return the weights of the fading at places, by number, for the fading at distances; the parts of missing
        places are added to them."""
        weights = np.sinc((distances_m - self.first_m) / self.apart_m - numbers[:, None])
        return np.asarray(weights / np.sqrt(np.sum(weights ** 2, axis=0)))
