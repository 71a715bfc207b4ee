"""Score of a rectangle: evidence of the surfels for a Car."""
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

# Contradicting surfels: deep inside the Car, or outward-facing continued surfaces next to
# the outline.
DEEP_M, BESIDE_M = 0.55, 0.50
COVER_BIN_M = 0.25
# A Car whose sides continue by this much in this range beyond one of its ends is longer.
CONTINUED_FROM_M, CONTINUED_TO_M, CONTINUED_M = 0.1, 0.5, 0.3
# Spread of the measured size around a known size, or beyond ordinary sizes.
LENGTH_SPREAD_M, WIDTH_SPREAD_M = 0.3, 0.15
# 1 sigma of the starting place, for the choice between two similar candidates.
PLACE_SIGMA_M, PLACE_SIGMA_RAD = 0.8, math.radians(12.0)


@dataclass(frozen=True)
class Score:
    """Evidence for a rectangle, each 0 to 1.

    Attributes:
        quality: likelihood that the object is a Car.
        total: quality, weighted by the agreement with the expected pose.
        cover: share of the outline that was seen.
    """

    quality: float
    total: float
    cover: float


def score_of(surfels: Surfels, car: Rectangle, prior: Prior, sheet: DataSheet) -> Score:
    """Return the evidence of surfels in map for the Car."""
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
    """Return the share of the surface explained by the other rectangle that the Car does not explain."""
    explained, anew = (belongs(surfels.in_frame(each.pose), each) for each in (car, other))
    return float(surfels.length[anew & ~explained].sum() / max(surfels.length[anew].sum(), 1e-9))


def cover_of(explained: Surfels, car: Rectangle) -> float:
    """Return the share of the outline that has an outward-facing surface."""
    covered = total = 0
    for name, outwards in OUTWARDS.items():
        half = 0.5 * (car.width if name in ("front", "rear") else car.length)
        # In NumPy 1.17 (Ubuntu 20.04), round() of a NumPy number does not return an int.
        bins = max(round(float(2.0 * half / COVER_BIN_M)), 1)
        mine = explained.where(explained.normal @ np.array(outwards) > MIN_OUTWARD_COSINE)
        along = mine.samples()[0] @ np.abs(np.array(outwards[::-1]))
        counts, _ = np.histogram(along, bins=bins, range=(-half, half))
        covered, total = covered + np.count_nonzero(counts), total + bins
    return covered / total


def _size_likelihood(car: Rectangle, sheet: DataSheet) -> float:
    """Return the likelihood of a size: 1 for a plausible one, decreasing with the deviation."""
    lengths = (sheet.known_length_m,) * 2 if sheet.known_length_m else ORDINARY_LENGTH_M
    widths = (sheet.known_width_m,) * 2 if sheet.known_width_m else ORDINARY_WIDTH_M
    return math.exp(-0.5 * (_beyond(car.length, lengths) / LENGTH_SPREAD_M) ** 2
                    - 0.5 * (_beyond(car.width, widths) / WIDTH_SPREAD_M) ** 2)


def _beyond(value: float, limits: Tuple[float, float]) -> float:
    return max(limits[0] - value, value - limits[1], 0.0)


def _continued_m(seen: Surfels, car: Rectangle) -> float:
    """Return the surface on the lines of the long sides just beyond their ends, m."""
    beyond, aside = (np.abs(seen.position) - (0.5 * car.length, 0.5 * car.width)).T
    faces_out = seen.normal[:, 1] * np.sign(seen.position[:, 1]) > MIN_OUTWARD_COSINE
    on_line = (beyond > CONTINUED_FROM_M) & (beyond < CONTINUED_TO_M) & (np.abs(aside) < BEYOND_M) & faces_out
    return float(seen.length[on_line].sum())


def _along(seen: Surfels, car: Rectangle) -> BoolArray:
    """Return a mask of surfels next to a side; at a corner, a neighbour may have surfaces of that direction."""
    return np.any(np.abs(seen.position) < (0.5 * car.length, 0.5 * car.width), axis=1)
