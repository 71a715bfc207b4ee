"""Ends of a Car from its axles: prior of the overhangs, and data sheet."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..parameters import DATA_SHEET_SIGMA_M, DataSheet
from .axles import Axles
from .ends import Ends, Estimate

# Overhangs relative to the wheelbase in makers' data sheets, mean and 1 sigma. Front: 0.2 (smallest class of Japan) to
# 0.37 (large saloons). Rear: 0.15 to 0.48 (Ford Crown Victoria). Front and rear overhangs are correlated.
FRONT_SHARE, FRONT_SHARE_SIGMA = 0.32, 0.06
REAR_SHARE, REAR_SHARE_SIGMA = 0.32, 0.09
CORRELATION = 0.4
_FRONT, _REAR, _BOTH = np.array([1.0, 0.0]), np.array([0.0, 1.0]), np.array([1.0, 1.0])


class _Gaussian(NamedTuple):
    """Two lengths (2,) in m, of the front and of the rear, and their covariance (2, 2)."""

    mean: FloatArray
    covariance: FloatArray

    def given(self, factors: FloatArray, known_m: float) -> "_Gaussian":
        """Return the posterior for the data sheet value known_m of factors @ mean."""
        gain = self.covariance @ factors / (factors @ self.covariance @ factors + DATA_SHEET_SIGMA_M ** 2)
        return _Gaussian(self.mean + gain * (known_m - factors @ self.mean),
                         self.covariance - np.outer(gain, factors @ self.covariance))

    def sigma(self, factors: FloatArray) -> float:
        """Return 1 sigma of factors @ mean."""
        return math.sqrt(max(float(factors @ self.covariance @ factors), 0.0))


def ends_on(axles: Axles, sheet: DataSheet) -> Ends:
    """Return front and rear from the axles only, with a known length or front overhang if available."""
    found = _outwards(axles, sheet)
    if sheet.known_length_m:
        found = found.given(_BOTH, sheet.known_length_m)
    ahead_m, behind_m = (float(value_m) for value_m in found.mean)
    return Ends(ahead_m, -behind_m, found.sigma(_FRONT), found.sigma(_REAR), found.sigma(_BOTH))


def outwards_of(axles: Axles, sheet: DataSheet) -> Tuple[Estimate, Estimate]:
    """Return the distances of front and rear outwards of the origin, from axles and overhang but not length."""
    found = _outwards(axles, sheet)
    return (Estimate(float(found.mean[0]), found.sigma(_FRONT)),
            Estimate(float(found.mean[1]), found.sigma(_REAR)))


def _outwards(axles: Axles, sheet: DataSheet) -> _Gaussian:
    sigmas = axles.wheelbase_m * np.array([FRONT_SHARE_SIGMA, REAR_SHARE_SIGMA])
    overhangs = _Gaussian(axles.wheelbase_m * np.array([FRONT_SHARE, REAR_SHARE]),
                          np.outer(sigmas, sigmas) * ((1.0, CORRELATION), (CORRELATION, 1.0)))
    if sheet.front_overhang_m:
        overhangs = overhangs.given(_FRONT, sheet.front_overhang_m)
    # An axle error ahead moves the front outwards and the rear inwards.
    shared_m2 = -axles.covariance_m2
    errors = np.array([[axles.front_sigma_m ** 2, shared_m2], [shared_m2, axles.rear_sigma_m ** 2]])
    return _Gaussian(overhangs.mean + (axles.front_m, -axles.rear_m), overhangs.covariance + errors)
