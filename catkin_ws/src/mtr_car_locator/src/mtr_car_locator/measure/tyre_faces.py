"""Outer faces of the tyres from all returns of the drive: parts of a level with the length of a tyre."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Tuple

import numpy as np

from mtr_core.arrays import FloatArray, IntArray

from .close_up import CloseUp
from .incidence import MIN_TYRE_INCIDENCE_COSINE
from .side import OUTWARDS
from .wheels import MAX_FACE_M, MIN_FACE_M, Face

BIN_M = 0.01
# Gate of returns round the level of a face, for noise, sway of the robot, and the error of the level.
NEAR_M = 0.06
# Sills and bumpers that are met occasionally on uneven ground have a tenth of a face's returns.
MIN_SHARE_OF_DENSEST, DENSEST_PERCENT = 0.25, 90.0
MIN_RETURNS = 100
# Shorter gaps, in bins, do not end a face: on a Car with free-standing tyres, and between a tyre and its wheel arch,
# which is 4 to 9 cm away at the height of the hub. This number of bins at both ends is smeared.
GAP_BINS, ARCH_GAP_BINS, SMEARED_BINS = 5, 2, 3


def faces_in(close_up: CloseUp, name: str, level_m: float, *, in_arches: bool = False) -> List[Face]:
    """Return the faces along the side `name` at its level, from the rear; close_up is in the Car's frame.

    in_arches: the body is also at that height, so only the gaps of the wheel arches end a face. A face ends at half of
    the return density of its middle. Noise and different heights smear both ends equally, so the middle is accurate to
    millimetres although the length is not.
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
    """Return the positions where the density falls to half of its middle value, in bins."""
    half = 0.5 * float(np.median(density[low + SMEARED_BINS:high + 1 - SMEARED_BINS]))
    full = np.nonzero(density[low:high + 1] >= half)[0] + low
    return _crossing(density, full[0], -1, half), _crossing(density, full[-1], 1, half)


def _crossing(density: FloatArray, last: int, step: int, half: float) -> float:
    inside, outside = density[last], density[last + step]
    return last + step * (inside - half) / (inside - outside) if outside < inside else float(last)
