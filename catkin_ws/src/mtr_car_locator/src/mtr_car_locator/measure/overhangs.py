"""Ends of a Car by its axles: the prior of a car's overhangs, and what the data sheet says of this one's."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..parameters import DATA_SHEET_SIGMA_M, DataSheet
from .axles import Axles
from .ends import Ends, Estimate

# Overhangs by the wheelbase on makers' data sheets, mean and 1 sigma. Front: 0.2 (the smallest class of Japan) to 0.37
# (large saloons). Rear: 0.15 to 0.48 (Ford Crown Victoria). Long front overhangs come with long rear ones.
FRONT_SHARE, FRONT_SHARE_SIGMA = 0.32, 0.06
REAR_SHARE, REAR_SHARE_SIGMA = 0.32, 0.09
CORRELATION = 0.4
_FRONT, _REAR, _BOTH = np.array([1.0, 0.0]), np.array([0.0, 1.0]), np.array([1.0, 1.0])


class _Gaussian(NamedTuple):
    """Two lengths (2,) in m, of the front and of the rear, and their covariance (2, 2)."""

    mean: FloatArray
    covariance: FloatArray

    def given(self, factors: FloatArray, known_m: float) -> "_Gaussian":
        """The same when the data sheet says factors @ mean."""
        gain = self.covariance @ factors / (factors @ self.covariance @ factors + DATA_SHEET_SIGMA_M ** 2)
        return _Gaussian(self.mean + gain * (known_m - factors @ self.mean),
                         self.covariance - np.outer(gain, factors @ self.covariance))

    def sigma(self, factors: FloatArray) -> float:
        """1 sigma of factors @ mean."""
        return math.sqrt(max(float(factors @ self.covariance @ factors), 0.0))


def ends_on(axles: Axles, sheet: DataSheet) -> Ends:
    """Front and rear by the axles alone; a known length and a known front overhang count."""
    found = _outwards(axles, sheet)
    if sheet.known_length_m:
        found = found.given(_BOTH, sheet.known_length_m)
    ahead_m, behind_m = (float(value_m) for value_m in found.mean)
    return Ends(ahead_m, -behind_m, found.sigma(_FRONT), found.sigma(_REAR), found.sigma(_BOTH))


def outwards_of(axles: Axles, sheet: DataSheet) -> Tuple[Estimate, Estimate]:
    """Distances of front and rear outwards of the frame's origin, by the axles and the overhang, not by the length."""
    found = _outwards(axles, sheet)
    return (Estimate(float(found.mean[0]), found.sigma(_FRONT)),
            Estimate(float(found.mean[1]), found.sigma(_REAR)))


def _outwards(axles: Axles, sheet: DataSheet) -> _Gaussian:
    sigmas = axles.wheelbase_m * np.array([FRONT_SHARE_SIGMA, REAR_SHARE_SIGMA])
    overhangs = _Gaussian(axles.wheelbase_m * np.array([FRONT_SHARE, REAR_SHARE]),
                          np.outer(sigmas, sigmas) * ((1.0, CORRELATION), (CORRELATION, 1.0)))
    if sheet.front_overhang_m:
        overhangs = overhangs.given(_FRONT, sheet.front_overhang_m)
    # An axle farther ahead is farther outwards of the origin at the front, and less far at the rear.
    shared_m2 = -axles.covariance_m2
    errors = np.array([[axles.front_sigma_m ** 2, shared_m2], [shared_m2, axles.rear_sigma_m ** 2]])
    return _Gaussian(overhangs.mean + (axles.front_m, -axles.rear_m), overhangs.covariance + errors)
