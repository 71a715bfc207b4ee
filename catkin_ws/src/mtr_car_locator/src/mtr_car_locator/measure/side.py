"""The four sides of the Car, and their surfels."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray, IntArray

from ..surfels import SAMPLE_M, Surfels

# Directions outwards in the Car's frame; the other coordinate runs along the side.
OUTWARDS = {"front": (1.0, 0.0), "rear": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}
ENDS, LONG_SIDES = ("front", "rear"), ("left", "right")
# A surfel belongs to a side if its normal is within 53 degrees of the side's direction: bumpers are round.
MIN_COSINE = 0.6
# Part of an end where its bumper is seen, but not the tyres, which also face forwards.
MIDDLE_SHARE = 0.6
# The outermost level requires this support within LAYER_M, which a mirror or a leg does not have. A mirror is 0.1 to
# 0.25 m long.
LAYER_M = 0.05
MIN_SUPPORT_M = {"front": 0.25, "rear": 0.25, "left": 0.4, "right": 0.4}
SUPPORT_SHARE = 0.12
# The extent is the mean surface near the level that this length of it reaches: with errors of millimetres, the
# outermost point of surfels would be too far out.
OUTERMOST_M = 0.02
# Share of a surfel's tilt that is used, because positions are known better than directions, and the ends of surfels
# stick out of round parts. Chosen together with OUTERMOST_M from 20 recorded drives with 2 cm of noise, each mapped in
# two ways. Width errors are -1 mm on average and 11 mm rms, length errors 1 and 5 mm. With the whole tilt, widths have
# 10 and 17 mm, lengths 5 and 7 mm.
TILT_SHARE = 0.7
MEAN_BELOW_M, MEAN_ABOVE_M = 0.006, 0.004
# Levels from surfels had errors of 5 mm (ends) to 8 mm (long sides) in 40 other drives, depending on the shape.
EXTENT_SIGMA_FLOOR_M = 0.005
# Share of a surface error that is common to a whole side; the rest is independent.
MAP_SHARE = 0.4
BIN_M = 0.10
MIN_IN_BIN_M = 0.03


@dataclass(frozen=True)
class SideExtent:
    """Outermost level of a side and its 1 sigma, m from the origin; map_sigma is the part of map surfaces."""

    level: float
    sigma: float
    map_sigma: float = 0.0


@dataclass(frozen=True)
class Side:
    """Surface of one side in samples of 1 cm: position along it, distance outwards, the surfel's sigma and number."""

    name: str
    along: FloatArray
    outward: FloatArray
    sigma: FloatArray
    surfel: IntArray

    @property
    def surface_m(self) -> float:
        """Length of the seen surface."""
        return len(self.along) * SAMPLE_M

    def within(self, low_m: float, high_m: float) -> "Side":
        """Return the part between two positions along the side."""
        keep = (self.along >= low_m) & (self.along <= high_m)
        return Side(self.name, self.along[keep], self.outward[keep], self.sigma[keep], self.surfel[keep])

    def extent(self) -> Optional[SideExtent]:
        """Return the outermost supported level, roughly; None without support."""
        order = np.argsort(-self.outward)
        levels = self.outward[order]
        needed_m = max(MIN_SUPPORT_M[self.name], SUPPORT_SHARE * self.surface_m)
        below = np.searchsorted(-levels, -(levels - LAYER_M), side="right") - np.arange(len(levels))
        supported = np.nonzero(below * SAMPLE_M >= needed_m)[0]
        if len(supported) == 0:
            return None
        order, levels = order[supported[0]:], levels[supported[0]:]
        top = levels[min(round(OUTERMOST_M / SAMPLE_M), len(levels) - 1)]
        used = (levels >= top - MEAN_BELOW_M) & (levels <= top + MEAN_ABOVE_M)
        return self._extent_of(order[used])

    def bins(self) -> Dict[int, float]:
        """Return the outermost level per bin of 10 cm along the side, without bins of little surface."""
        number = np.floor(self.along / BIN_M).astype(int)
        order = np.lexsort((-self.outward, number))
        number, outward = number[order], self.outward[order]
        found, rank = {}, round(MIN_IN_BIN_M / SAMPLE_M)
        for each in np.unique(number):
            levels = outward[number == each]
            if len(levels) > rank:
                top = levels[rank]
                found[int(each)] = float(levels[(levels >= top - LAYER_M / 2.0) & (levels <= top)].mean())
        return found

    def _extent_of(self, index: IntArray) -> SideExtent:
        levels = self.outward[index]
        surfels = len(np.unique(self.surfel[index]))
        # Errors of neighbouring surfels are common, as in the map's sigma; their scatter averages out.
        map_sigma = float(np.median(self.sigma[index]))
        sigma = math.hypot(map_sigma, float(levels.std()) / math.sqrt(surfels))
        return SideExtent(float(levels.mean()), math.hypot(sigma, EXTENT_SIGMA_FLOOR_M), map_sigma)


def side_of(name: str, in_car: Surfels, min_outward_m: float = 0.0, min_cosine: float = MIN_COSINE) -> Side:
    """Return the samples of a side from surfels in the Car's frame."""
    outwards = np.array(OUTWARDS[name])
    mine = np.nonzero(in_car.normal @ outwards > min_cosine)[0]
    seen = in_car.where(mine)
    points, index = seen.samples()
    along, middle = points @ np.abs(outwards[::-1]), (seen.position @ outwards)[index]
    outward = middle + TILT_SHARE * (points @ outwards - middle)
    keep = outward > min_outward_m
    return Side(name, along[keep], outward[keep], in_car.sigma[mine][index[keep]], mine[index[keep]])


def sides_of(in_car: Surfels) -> Dict[str, Side]:
    """Return all four sides."""
    return {name: side_of(name, in_car) for name in OUTWARDS}


def middle_of(half: Tuple[float, float], share: float) -> Tuple[float, float]:
    """Return the middle part of a span, by its share."""
    low, high = half
    centre, reach = 0.5 * (low + high), 0.5 * share * (high - low)
    return centre - reach, centre + reach
