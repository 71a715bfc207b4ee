"""Levels: distances at which a side has much surface."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..measure.side import Side
from ..surfels import SAMPLE_M

LEVEL_BIN_M, LEVEL_SIGMA_BINS = 0.02, 1.5
# Lowest surface of a level: half a sill, or the middle of a bumper.
MIN_SURFACE_M = {"front": 0.25, "rear": 0.25, "left": 0.4, "right": 0.4}
MAX_LEVELS = 5


def sharpness(side: Side) -> float:
    """Return the sum of the squared surface at each level."""
    density = smoothed(_surface_by_level(side)[0], LEVEL_SIGMA_BINS)
    return float(density @ density)


def levels(side: Side, at_most: int = MAX_LEVELS) -> List[float]:
    """Return the distances outwards with much surface, the largest first."""
    surface_m, low = _surface_by_level(side)
    density = smoothed(surface_m, LEVEL_SIGMA_BINS)
    # A single level with surface s has a peak of this height.
    height = MIN_SURFACE_M[side.name] / (LEVEL_SIGMA_BINS * math.sqrt(2.0 * math.pi))
    return [low + (index + 0.5) * LEVEL_BIN_M for index in peaks(density, height)[:at_most]]


def _surface_by_level(side: Side) -> Tuple[FloatArray, float]:
    """Return the surface in m in each bin of LEVEL_BIN_M outwards, and the start of the first bin."""
    if len(side.outward) == 0:
        return np.zeros(1), 0.0
    low = side.outward.min() - 5 * LEVEL_BIN_M
    count = math.ceil((side.outward.max() - low) / LEVEL_BIN_M) + 5
    counts, _ = np.histogram(side.outward, bins=count, range=(low, low + count * LEVEL_BIN_M))
    return counts * SAMPLE_M, float(low)


def smoothed(values: FloatArray, sigma_bins: float) -> FloatArray:
    """Convolve with a Gaussian."""
    reach = np.arange(-math.ceil(3 * sigma_bins), math.ceil(3 * sigma_bins) + 1)
    kernel = np.exp(-0.5 * (reach / sigma_bins) ** 2)
    return np.convolve(values.astype(float), kernel / kernel.sum(), mode="same")


def peaks(density: FloatArray, minimum: float) -> List[int]:
    """Return the indices of local maxima above a height, highest first."""
    padded = np.concatenate(([-1.0], density, [-1.0]))
    top = (density > padded[:-2]) & (density >= padded[2:]) & (density > 0.0) & (density >= minimum)
    return sorted(np.nonzero(top)[0].tolist(), key=lambda index: -density[index])
