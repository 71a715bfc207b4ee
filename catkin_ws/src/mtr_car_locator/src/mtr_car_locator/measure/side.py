"""The four sides of the Car, and what surfels show of each."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray, IntArray

from ..surfels import SAMPLE_M, Surfels

# These are the directions outwards in the Car's frame; along a side counts the other coordinate.
OUTWARDS = {"front": (1.0, 0.0), "rear": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}
ENDS, LONG_SIDES = ("front", "rear"), ("left", "right")
# A surfel belongs to a side when its normal is within 53 degrees of the side's direction: bumpers are round.
MIN_COSINE = 0.6
# A bumper is seen in the middle of the Car; tyres, which face forwards too, are not.
MIDDLE_SHARE = 0.6
# What reaches farther out than the side has to be supported by so much surface within LAYER_M: a mirror or a leg has
# less. A mirror is 0.1 to 0.25 m long.
LAYER_M = 0.05
MIN_SUPPORT_M = {"front": 0.25, "rear": 0.25, "left": 0.4, "right": 0.4}
SUPPORT_SHARE = 0.12
# The extent is the mean of the surface about the level that this much of it reaches: the very outermost point of
# surfels that are millimetres wrong would lie too far out.
OUTERMOST_M = 0.02
# A surfel's place is known better than its direction, and where the Car is round its ends stick out: so much of its
# tilt is believed. Chosen on 20 recorded drives with 2 cm of noise, each mapped in two ways, together with OUTERMOST_M:
# widths are off by -1 mm on average and 11 mm rms, lengths by 1 and 5 mm; with all of the tilt widths by 10 and 17 mm,
# lengths by 5 and 7 mm.
TILT_SHARE = 0.7
MEAN_BELOW_M, MEAN_ABOVE_M = 0.006, 0.004
# Levels by surfels alone were off by 5 mm (ends) to 8 mm (long sides) in 40 other drives, systematically by shape.
EXTENT_SIGMA_FLOOR_M = 0.005
# The error of one surface element is mostly its own; a whole side shares so much of it.
MAP_SHARE = 0.4
BIN_M = 0.10
MIN_IN_BIN_M = 0.03


@dataclass(frozen=True)
class SideExtent:
    """Outermost level of a side and its 1 sigma, m from the frame's origin; map_sigma is that of the map's surfaces."""

    level: float
    sigma: float
    map_sigma: float = 0.0


@dataclass(frozen=True)
class Side:
    """Surface of one side by samples of 1 cm: position along it, distance outwards, the surfel's sigma and number."""

    name: str
    along: FloatArray
    outward: FloatArray
    sigma: FloatArray
    surfel: IntArray

    @property
    def surface_m(self) -> float:
        """How much of it was seen."""
        return len(self.along) * SAMPLE_M

    def within(self, low_m: float, high_m: float) -> "Side":
        """The part of it between two positions along it."""
        keep = (self.along >= low_m) & (self.along <= high_m)
        return Side(self.name, self.along[keep], self.outward[keep], self.sigma[keep], self.surfel[keep])

    def extent(self) -> Optional[SideExtent]:
        """Outermost supported level, roughly; None without support."""
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
        """Outermost level per bin of 10 cm along the side, without what has next to no surface."""
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
        # Neighbouring surfels are wrong together by what the map's sigma says; their own scatter averages out.
        map_sigma = float(np.median(self.sigma[index]))
        sigma = math.hypot(map_sigma, float(levels.std()) / math.sqrt(surfels))
        return SideExtent(float(levels.mean()), math.hypot(sigma, EXTENT_SIGMA_FLOOR_M), map_sigma)


def side_of(name: str, in_car: Surfels, min_outward_m: float = 0.0, min_cosine: float = MIN_COSINE) -> Side:
    """What surfels in the Car's frame show of a side."""
    outwards = np.array(OUTWARDS[name])
    mine = np.nonzero(in_car.normal @ outwards > min_cosine)[0]
    seen = in_car.where(mine)
    points, index = seen.samples()
    along, middle = points @ np.abs(outwards[::-1]), (seen.position @ outwards)[index]
    outward = middle + TILT_SHARE * (points @ outwards - middle)
    keep = outward > min_outward_m
    return Side(name, along[keep], outward[keep], in_car.sigma[mine][index[keep]], mine[index[keep]])


def sides_of(in_car: Surfels) -> Dict[str, Side]:
    """All four sides."""
    return {name: side_of(name, in_car) for name in OUTWARDS}


def middle_of(half: Tuple[float, float], share: float) -> Tuple[float, float]:
    """Middle part of a span, by its share."""
    low, high = half
    centre, reach = 0.5 * (low + high), 0.5 * share * (high - low)
    return centre - reach, centre + reach
