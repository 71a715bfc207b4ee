"""Tyres of the side to which the robot does not get: under the Car their inner faces are seen, not their outer ones."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass, replace
from typing import Iterator, List, Optional

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray

from ..measure.side import LONG_SIDES, MIN_COSINE, OUTWARDS, Side, side_of
from ..measure.wheels import FACE_DEPTH_M, SQUARE_M, Face, FacePair, face_pairs, off_square_m
from ..surfels import Surfels, joined
from .levels import levels

# Nominal widths of passenger cars' and delivery vans' tyres are 0.145 to 0.285 m.
MIN_TYRE_M, MAX_TYRE_M = 0.12, 0.30
# Tracks of such cars are 1.2 to 1.9 m: so far apart are the inner faces.
MIN_BETWEEN_M, MAX_BETWEEN_M = 0.9, 1.75
# What is under a Car, and what stands beside it, has more levels than the sides of a body.
MAX_LEVELS = 12


@dataclass(frozen=True)
class _NearTyres:
    """Two tyres that are seen from both their sides: where along the Car, and the levels of their faces, m outwards."""

    faces: FacePair
    outer_m: float
    inner_m: float


def with_far_tyres(in_frame: Surfels) -> Iterator[Surfels]:
    """The surfels, in a frame whose x axis is the Car's, and in each way in which they may be those of a Car that is
    seen from one side, the same with the outer faces of the other side's tyres.

    The tyres of an axle are of one size: an outer face lies as far from its inner one as on the side that is seen.
    """
    yield in_frame
    for near, far in (LONG_SIDES, LONG_SIDES[::-1]):
        towards, away = (side_of(name, in_frame, -math.inf) for name in (near, far))
        for tyres in _near_tyres(towards, away):
            inner_m = _far_level(towards, away, tyres)
            if inner_m is not None:
                yield _with_outer_faces(in_frame, near, tyres, inner_m)


def _near_tyres(towards: Side, away: Side) -> Iterator[_NearTyres]:
    for outer_m, inward_m in itertools.product(levels(towards, MAX_LEVELS), levels(away, MAX_LEVELS)):
        if MIN_TYRE_M <= outer_m + inward_m <= MAX_TYRE_M:
            pair = _square_pair(towards, outer_m, list(face_pairs(away, inward_m)))
            if pair is not None:
                yield _NearTyres(pair, outer_m, -inward_m)


def _square_pair(side: Side, level_m: float, others: List[FacePair]) -> Optional[FacePair]:
    """The two faces at a level that are squarest to one of the others; None when none is."""
    both = [(off_square_m(pair, other), pair) for pair in face_pairs(side, level_m) for other in others]
    off_m, pair = min(both, default=(math.inf, None), key=lambda each: each[0])
    return pair if off_m <= SQUARE_M else None


def _far_level(towards: Side, away: Side, tyres: _NearTyres) -> Optional[float]:
    """Where the inner faces of the far tyres are, m outwards of the near side; None where nothing stands as they do, or
    where the outer ones were seen.

    The next level is taken or none: behind the far tyres those of a neighbour may stand as these do.
    """
    level = max((each for each in levels(towards, MAX_LEVELS)
                 if MIN_BETWEEN_M <= tyres.inner_m - each <= MAX_BETWEEN_M), default=None)
    if level is None or _square_pair(towards, level, [tyres.faces]) is None:
        return None
    outer_m = tyres.outer_m - tyres.inner_m - level
    return level if _square_pair(away, outer_m, [tyres.faces]) is None else None


def _with_outer_faces(in_frame: Surfels, near: str, tyres: _NearTyres, inner_m: float) -> Surfels:
    """The surfels and the far tyres' outer faces, each as far from its inner one as on the near side of its axle."""
    outwards = np.array(OUTWARDS[near])
    found = [in_frame]
    for face in tyres.faces:
        outer, own_inner, inner = (in_frame.where(_of_face(in_frame, facing, level_m, face)) for facing, level_m in (
            (outwards, tyres.outer_m), (-outwards, -tyres.inner_m), (outwards, inner_m)))
        if not (len(outer) and len(own_inner)):
            continue
        width_m = float(np.median(outer.position @ outwards) - np.median(own_inner.position @ outwards))
        sigma_m = math.hypot(float(np.median(outer.sigma)), float(np.median(own_inner.sigma)))
        found.append(replace(inner, position=inner.position - width_m * outwards, normal=-inner.normal,
                             sigma=np.hypot(inner.sigma, sigma_m)))
    return joined(*found)


def _of_face(in_frame: Surfels, facing: FloatArray, level_m: float, face: Face) -> BoolArray:
    """Mask of the surfels that face so, at that level, about as far along as the face."""
    along = in_frame.position[:, 0]
    return ((in_frame.normal @ facing > MIN_COSINE) & (np.abs(in_frame.position @ facing - level_m) <= FACE_DEPTH_M)
            & (along >= face.low_m - SQUARE_M) & (along <= face.high_m + SQUARE_M))
