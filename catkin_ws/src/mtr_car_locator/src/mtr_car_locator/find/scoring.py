"""How well a rectangle explains what surfels show: the evidence that there stands a Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

import numpy as np

from mtr_core.arrays import BoolArray

from ..measure.belonging import BEYOND_M, MIN_OUTWARD_COSINE, belongs, facing
from ..measure.side import OUTWARDS
from ..parameters import DataSheet
from ..rectangle import Rectangle
from ..surfels import Surfels
from .prior import Prior

# A surfel speaks against a Car there when it lies deep inside, where no surface of a Car can be seen, or when it is a
# continued surface that faces outwards beside the outline.
DEEP_M, BESIDE_M = 0.55, 0.50
COVER_BIN_M = 0.25
# Wheels alone cover a quarter to a third of the outline, two sides half of it.
LENGTH_SPREAD, WIDTH_SPREAD_M = 1.0, 0.4
# The starting place has this 1 sigma in the choice between two that look alike.
PLACE_SIGMA_M, PLACE_SIGMA_RAD = 0.8, math.radians(12.0)


@dataclass(frozen=True)
class Score:
    """Evidence for a rectangle, 0 to 1 each.

    Attributes:
        quality: that what was seen is a Car.
        total: the same times how well it stands where the Car should.
        cover: share of the outline that was seen.
    """

    quality: float
    total: float
    cover: float


def score_of(surfels: Surfels, car: Rectangle, prior: Prior, sheet: DataSheet) -> Score:
    """Evidence that surfels in map give for the Car."""
    seen = surfels.in_frame(car.pose)
    outside = car.outside(seen.position)
    explained = belongs(seen, car)
    beside = (outside > BEYOND_M) & (outside < BESIDE_M) & (facing(seen, car) > MIN_OUTWARD_COSINE) & _along(seen, car)
    contradicting = (outside < -DEEP_M) | beside
    good, bad = seen.length[explained].sum(), seen.length[contradicting].sum()
    if good <= 0.0:
        return Score(0.0, 0.0, 0.0)
    cover = cover_of(seen.where(explained), car)
    size = math.exp(-0.5 * ((car.length - sheet.length_m) / LENGTH_SPREAD) ** 2
                    - 0.5 * ((car.width - sheet.width_m) / WIDTH_SPREAD_M) ** 2)
    quality = float(cover * good / (good + bad) * size)
    off_m, off_rad = prior.error_of(car.pose)
    place = math.exp(-0.5 * (off_m / PLACE_SIGMA_M) ** 2 - 0.5 * (off_rad / PLACE_SIGMA_RAD) ** 2)
    return Score(quality, quality * place, cover)


def cover_of(explained: Surfels, car: Rectangle) -> float:
    """Share of the outline beside which there is a surface that faces outwards."""
    covered = total = 0
    for name, outwards in OUTWARDS.items():
        half = 0.5 * (car.width if name in ("front", "rear") else car.length)
        bins = max(round(2.0 * half / COVER_BIN_M), 1)
        mine = explained.where(explained.normal @ np.array(outwards) > MIN_OUTWARD_COSINE)
        along = mine.samples()[0] @ np.abs(np.array(outwards[::-1]))
        counts, _ = np.histogram(along, bins=bins, range=(-half, half))
        covered, total = covered + np.count_nonzero(counts), total + bins
    return covered / total


def _along(seen: Surfels, car: Rectangle) -> BoolArray:
    """True beside a side, not beside a corner: there a neighbour may well show a surface that faces the same way."""
    return np.any(np.abs(seen.position) < (0.5 * car.length, 0.5 * car.width), axis=1)
