"""The outer surface of one side of the Car, in bins along that side."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

BIN_M = 0.10
# A bin needs this many hits for its surface to count.
LEAST_HITS_IN_BIN = 6
# The surface is the median of this layer below the outermost points; what lies deeper is the underbody. The layer is
# thick against the blur of range and pose noise, so that the median is not pulled outwards.
OUTER_QUANTILE = 0.97
LAYER_M = 0.20
# The extent is the outermost level at which enough bins agree: a person's leg or a mirror has too few of them.
AGREE_M = 0.03
LEAST_AGREEING = 3
AGREEING_SHARE = 0.12
# A side is seen when bins cover this share of it.
SEEN_SHARE = 0.3
MAD_TO_SIGMA = 1.4826


@dataclass(frozen=True)
class Profile:
    """Surface of one side: position along it and outwards, and the spread of the points, one entry per bin."""

    along: np.ndarray
    outward: np.ndarray
    spread: np.ndarray

    def is_seen(self, side_m: float) -> bool:
        """True when enough of a side of the given length was hit."""
        return len(self.along) * BIN_M >= SEEN_SHARE * side_m

    def extent(self) -> Optional[Tuple[float, float]]:
        """Outermost supported level and its sigma; None without support."""
        levels = np.sort(self.outward)[::-1]
        needed = max(LEAST_AGREEING, math.ceil(AGREEING_SHARE * len(levels)))
        for first in range(len(levels) - needed + 1):
            window = levels[first:first + needed]
            if window[0] - window[-1] <= AGREE_M:
                return float(window.mean()), float(math.hypot(0.01, 0.5 * np.median(self.spread)))
        return None


def profile_of(along: np.ndarray, outward: np.ndarray, hits: np.ndarray) -> Profile:
    """Profile of the points on the outer half (outward > 0) of the Car."""
    outer = outward > 0.0
    along, outward, hits = along[outer], outward[outer], hits[outer]
    bins = np.floor(along / BIN_M).astype(int)
    rows = []
    for number in np.unique(bins):
        mine = bins == number
        if hits[mine].sum() >= LEAST_HITS_IN_BIN:
            rows.append(((number + 0.5) * BIN_M, *_surface(outward[mine], hits[mine])))
    table = np.array(rows).reshape(-1, 3)
    return Profile(table[:, 0], table[:, 1], table[:, 2])


def _surface(outward: np.ndarray, hits: np.ndarray) -> Tuple[float, float]:
    layer = outward > weighted_quantile(outward, hits, OUTER_QUANTILE) - LAYER_M
    level = weighted_quantile(outward[layer], hits[layer], 0.5)
    return level, MAD_TO_SIGMA * weighted_quantile(np.abs(outward[layer] - level), hits[layer], 0.5)


def weighted_quantile(values: np.ndarray, weights: np.ndarray, share: float) -> float:
    """Value below which the share of the weight lies."""
    order = np.argsort(values)
    centres = np.cumsum(weights[order]) - 0.5 * weights[order]
    return float(np.interp(share * weights.sum(), centres, values[order]))
