"""How well a rectangle explains what surfels show: the evidence that there stands a Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Tuple

import numpy as np

from mtr_core.arrays import BoolArray

from ..measure.belonging import BEYOND_M, MIN_OUTWARD_COSINE, belongs, facing
from ..measure.side import OUTWARDS
from ..parameters import ORDINARY_LENGTH_M, ORDINARY_WIDTH_M, DataSheet
from ..rectangle import Rectangle
from ..surfels import Surfels
from .prior import Prior

# A surfel speaks against a Car there when it lies deep inside, where no surface of a Car can be seen, or when it is a
# continued surface that faces outwards beside the outline.
DEEP_M, BESIDE_M = 0.55, 0.50
COVER_BIN_M = 0.25
# A Car whose sides go on by so much in this stretch beyond one of its ends is longer than that.
CONTINUED_FROM_M, CONTINUED_TO_M, CONTINUED_M = 0.1, 0.5, 0.3
# What the LiDARs' plane shows of a Car of a known size, or beyond the ordinary ones.
LENGTH_SPREAD_M, WIDTH_SPREAD_M = 0.3, 0.15
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
    if good <= 0.0 or _continued_m(seen, car) > CONTINUED_M:
        return Score(0.0, 0.0, 0.0)
    cover = cover_of(seen.where(explained), car)
    quality = float(cover * good / (good + bad) * _size_likelihood(car, sheet))
    off_m, off_rad = prior.error_of(car.pose)
    place = math.exp(-0.5 * (off_m / PLACE_SIGMA_M) ** 2 - 0.5 * (off_rad / PLACE_SIGMA_RAD) ** 2)
    return Score(quality, quality * place, cover)


def new_share(surfels: Surfels, car: Rectangle, other: Rectangle) -> float:
    """Of the surface that the other rectangle explains, the share that the Car's does not."""
    explained, anew = (belongs(surfels.in_frame(each.pose), each) for each in (car, other))
    return float(surfels.length[anew & ~explained].sum() / max(surfels.length[anew].sum(), 1e-9))


def cover_of(explained: Surfels, car: Rectangle) -> float:
    """Share of the outline beside which there is a surface that faces outwards."""
    covered = total = 0
    for name, outwards in OUTWARDS.items():
        half = 0.5 * (car.width if name in ("front", "rear") else car.length)
        # Of a number of NumPy 1.17, Ubuntu 20.04's, round() makes no whole one.
        bins = max(round(float(2.0 * half / COVER_BIN_M)), 1)
        mine = explained.where(explained.normal @ np.array(outwards) > MIN_OUTWARD_COSINE)
        along = mine.samples()[0] @ np.abs(np.array(outwards[::-1]))
        counts, _ = np.histogram(along, bins=bins, range=(-half, half))
        covered, total = covered + np.count_nonzero(counts), total + bins
    return covered / total


def _size_likelihood(car: Rectangle, sheet: DataSheet) -> float:
    """1 for a size that a Car may have, less the farther it is from that."""
    lengths = (sheet.known_length_m,) * 2 if sheet.known_length_m else ORDINARY_LENGTH_M
    widths = (sheet.known_width_m,) * 2 if sheet.known_width_m else ORDINARY_WIDTH_M
    return math.exp(-0.5 * (_beyond(car.length, lengths) / LENGTH_SPREAD_M) ** 2
                    - 0.5 * (_beyond(car.width, widths) / WIDTH_SPREAD_M) ** 2)


def _beyond(value: float, limits: Tuple[float, float]) -> float:
    return max(limits[0] - value, value - limits[1], 0.0)


def _continued_m(seen: Surfels, car: Rectangle) -> float:
    """Surface on the lines of the long sides just beyond their ends, m."""
    beyond, aside = (np.abs(seen.position) - (0.5 * car.length, 0.5 * car.width)).T
    faces_out = seen.normal[:, 1] * np.sign(seen.position[:, 1]) > MIN_OUTWARD_COSINE
    on_line = (beyond > CONTINUED_FROM_M) & (beyond < CONTINUED_TO_M) & (np.abs(aside) < BEYOND_M) & faces_out
    return float(seen.length[on_line].sum())


def _along(seen: Surfels, car: Rectangle) -> BoolArray:
    """True beside a side, not beside a corner: there a neighbour may well show a surface that faces the same way."""
    return np.any(np.abs(seen.position) < (0.5 * car.length, 0.5 * car.width), axis=1)
