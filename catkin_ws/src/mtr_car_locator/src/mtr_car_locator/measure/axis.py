"""Axis of symmetry of the Car from its long sides: heading and lateral position."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from .side import BIN_M, MAP_SHARE, Side

# Excluded ends of a side: they curve towards the bumpers and would rotate the axis of a single side. For a short Car
# with a high sill, a shorter length is excluded, because otherwise its wheels would be missing; its bumpers are short,
# too.
ENDS_M = (0.6, 0.3)
MIN_BINS = 6
# Scatter of a car's surface about its symmetric shape; bins farther away have less weight.
SHAPE_SIGMA_M = 0.005
ROUNDS = 8


@dataclass(frozen=True)
class SymmetryAxis:
    """Slope and offset of the axis in the frame of the sides, with sigmas.

    is_centred: False if only one side was seen; the offset then refers to that side.
    """

    slope: float
    offset_m: float
    slope_sigma: float
    offset_sigma_m: float
    is_centred: bool


def axis_of(left: Side, right: Side, *, length: float) -> Optional[SymmetryAxis]:
    """Return the middle between both sides, or a parallel to a single one; None without sufficient data."""
    lefts, rights = left.bins(), right.bins()
    both = sorted(set(lefts) & set(rights))
    if len(both) >= MIN_BINS:
        middle = np.array([0.5 * (lefts[number] - rights[number]) for number in both])
        sigma = 0.5 * math.hypot(_sigma(left), _sigma(right))
        return _axis((np.array(both) + 0.5) * BIN_M, middle, sigma, is_centred=True)
    for ends_m, (side, bins, sign) in itertools.product(ENDS_M, ((left, lefts, 1.0), (right, rights, -1.0))):
        inner = [number for number in sorted(bins) if abs((number + 0.5) * BIN_M) < 0.5 * length - ends_m]
        if len(inner) >= MIN_BINS:
            levels = sign * np.array([bins[number] for number in inner])
            return _axis((np.array(inner) + 0.5) * BIN_M, levels, _sigma(side), is_centred=False)
    return None


def _axis(along: FloatArray, level: FloatArray, common_sigma_m: float, is_centred: bool) -> SymmetryAxis:
    slope, offset, slope_sigma, offset_sigma = robust_line(along, level)
    # Errors of the map on one side may differ between its ends.
    span = max(float(np.ptp(along)), BIN_M)
    return SymmetryAxis(slope, offset, math.hypot(slope_sigma, math.sqrt(2.0) * common_sigma_m / span),
                math.hypot(offset_sigma, common_sigma_m), is_centred)


def robust_line(along: FloatArray, level: FloatArray) -> Tuple[float, float, float, float]:
    """Return slope and offset at 0 of the line through most points, and their 1 sigma from the scatter."""
    matrix = np.column_stack((along, np.ones_like(along)))
    weights = np.ones(len(level))
    line = np.array([0.0, float(np.median(level))])
    for _ in range(ROUNDS):
        line = np.linalg.lstsq(matrix * weights[:, np.newaxis], level * weights, rcond=None)[0]
        rest = level - matrix @ line
        weights = 1.0 / np.sqrt(1.0 + (rest / SHAPE_SIGMA_M) ** 2)
    scatter = math.sqrt(float(np.sum((weights * rest) ** 2) / max(np.sum(weights ** 2) - 2.0, 1.0)))
    covariance = np.linalg.inv((matrix * weights[:, np.newaxis] ** 2).T @ matrix) * max(scatter, 1e-4) ** 2
    return float(line[0]), float(line[1]), math.sqrt(covariance[0, 0]), math.sqrt(covariance[1, 1])


def _sigma(side: Side) -> float:
    return MAP_SHARE * float(np.median(side.sigma)) if len(side.sigma) else 0.0
