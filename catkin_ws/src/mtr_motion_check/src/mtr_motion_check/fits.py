"""Straight lines through two sensors' values of the same steps: their ratio."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional, Sequence

import numpy as np

from mtr_core.arrays import FloatArray

MIN_STEPS = 3
# Residuals beyond this multiple of their median size are outliers: a person walked by or a wheel slipped. The median is
# over the steps with motion of at least this share of the largest: at standstill all agree.
OUTLIER, MOVING_SHARE = 4.0, 0.25


class Ratio(NamedTuple):
    """Ratio of one sensor's values to another's, with its standard error."""

    value: float
    sigma: float

    def differs(self, expected: float, tolerance: float) -> bool:
        """Return True if the difference exceeds the tolerance and two standard errors."""
        return abs(self.value - expected) > tolerance + 2.0 * self.sigma


def ratio(known: Sequence[float], said: Sequence[float], offsets: Optional[Sequence[float]] = None) -> Optional[Ratio]:
    """Estimate said = ratio * known, plus an estimated constant times the offsets; None with too few steps."""
    columns = [known] if offsets is None else [known, offsets]
    matrix, wanted = np.array(columns, dtype=float).T, np.array(said, dtype=float)
    if len(wanted) < MIN_STEPS + len(columns) - 1:
        return None
    kept = np.ones(len(wanted), dtype=bool)
    for _ in range(2):
        residuals = wanted - matrix @ solved(matrix[kept], wanted[kept])
        moving = np.abs(matrix[:, 0]) >= MOVING_SHARE * np.abs(matrix[:, 0]).max()
        kept = np.abs(residuals) <= OUTLIER * np.median(np.abs(residuals[moving])) + 1e-12
    residuals = (wanted - matrix @ solved(matrix[kept], wanted[kept]))[kept]
    spare = max(1, len(residuals) - len(columns))
    variance = float(residuals @ residuals) / spare * np.linalg.pinv(matrix[kept].T @ matrix[kept])[0, 0]
    return Ratio(float(solved(matrix[kept], wanted[kept])[0]), math.sqrt(max(0.0, variance)))


def solved(matrix: FloatArray, wanted: FloatArray) -> FloatArray:
    """Solve by least squares."""
    found: FloatArray = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
    return found
