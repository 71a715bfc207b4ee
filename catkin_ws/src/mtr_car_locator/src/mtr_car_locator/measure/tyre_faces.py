"""Outer faces of the tyres from all returns of the way round: what stands at a level, as long as a tyre is."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Tuple

import numpy as np

from mtr_core.arrays import FloatArray, IntArray

from .close_up import CloseUp
from .incidence import MIN_TYRE_INCIDENCE_COSINE
from .side import OUTWARDS
from .wheels import MAX_FACE_M, MIN_FACE_M, Face

BIN_M = 0.01
# Returns so near the level are the face's: noise, the robot's sway, and how far the level itself may be off.
NEAR_M = 0.06
# Sills and bumpers that the LiDARs meet now and then, where the ground is uneven, have a tenth of a face's returns.
MIN_SHARE_OF_DENSEST, DENSEST_PERCENT = 0.25, 90.0
MIN_RETURNS = 100
# A shorter gap, in bins, is no end: on a Car whose tyres stand alone, and between a tyre and its wheel arch, which at
# the height of the hub is 4 to 9 cm away. So many bins at both ends are smeared.
GAP_BINS, ARCH_GAP_BINS, SMEARED_BINS = 5, 2, 3


def faces_in(close_up: CloseUp, name: str, level_m: float, *, in_arches: bool = False) -> List[Face]:
    """The faces along the side `name` at its level, from the rear; close_up is in the Car's frame.

    in_arches: the body is at that height, too, so that only the gaps of the wheel arches end a face.

    A face ends where half as many returns are as in its midst: noise and the heights at which it was met smear both its
    ends alike, so the middle is exact to millimetres although the length is not.
    """
    outwards = np.array(OUTWARDS[name])
    facing = close_up.beams @ outwards < -MIN_TYRE_INCIDENCE_COSINE
    along = close_up.points[facing & (np.abs(close_up.points @ outwards - level_m) < NEAR_M)] @ np.abs(outwards[::-1])
    if len(along) < MIN_RETURNS:
        return []
    first = np.floor(along.min() / BIN_M) - GAP_BINS
    count = np.bincount((np.floor(along / BIN_M) - first).astype(int), minlength=2 * GAP_BINS)
    density = np.convolve(np.append(count, np.zeros(GAP_BINS)), np.full(3, 1.0 / 3.0), "same")
    minimum = MIN_SHARE_OF_DENSEST * np.percentile(density[density > 0.0], DENSEST_PERCENT)
    gap_bins = ARCH_GAP_BINS if in_arches else GAP_BINS
    ends = [_ends(density, *piece) for piece in _pieces(np.nonzero(density > minimum)[0], gap_bins)]
    faces = [Face((first + 0.5 + low) * BIN_M, (first + 0.5 + high) * BIN_M) for low, high in ends]
    return [face for face in faces if MIN_FACE_M <= face.size_m <= MAX_FACE_M]


def _pieces(bins: IntArray, gap_bins: int) -> List[Tuple[int, int]]:
    parts = np.split(bins, np.nonzero(np.diff(bins) > gap_bins)[0] + 1)
    return [(part[0], part[-1]) for part in parts if (part[-1] - part[0]) * BIN_M >= MIN_FACE_M]


def _ends(density: FloatArray, low: int, high: int) -> Tuple[float, float]:
    """Where the density crosses half of what it is in the midst, in bins."""
    half = 0.5 * float(np.median(density[low + SMEARED_BINS:high + 1 - SMEARED_BINS]))
    full = np.nonzero(density[low:high + 1] >= half)[0] + low
    return _crossing(density, full[0], -1, half), _crossing(density, full[-1], 1, half)


def _crossing(density: FloatArray, last: int, step: int, half: float) -> float:
    inside, outside = density[last], density[last + step]
    return last + step * (inside - half) / (inside - outside) if outside < inside else float(last)
