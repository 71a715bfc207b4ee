"""Tyres of the inaccessible side: their inner faces are seen under the Car, but not their outer ones."""
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

# Nominal widths of tyres of passenger cars and delivery vans are 0.145 to 0.285 m.
MIN_TYRE_M, MAX_TYRE_M = 0.12, 0.30
# Distance of the inner faces; tracks of such cars are 1.2 to 1.9 m.
MIN_BETWEEN_M, MAX_BETWEEN_M = 0.9, 1.75
# Objects under and next to a Car have more levels than the sides of a body.
MAX_LEVELS = 12


@dataclass(frozen=True)
class _NearTyres:
    """Two tyres that are seen from both sides: positions along the Car, and levels of their faces, m outwards."""

    faces: FacePair
    outer_m: float
    inner_m: float


def with_far_tyres(in_frame: Surfels) -> Iterator[Surfels]:
    """Yield the surfels, and variants with the outer faces of the far tyres for a Car seen from one side.

    The frame has its x axis along the Car. Tyres of one axle have equal sizes: the distance between outer and inner
    face is the one measured on the near side.
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
    """Return the faces at a level that are squarest to one of the others; None if there are none."""
    both = [(off_square_m(pair, other), pair) for pair in face_pairs(side, level_m) for other in others]
    off_m, pair = min(both, default=(math.inf, None), key=lambda each: each[0])
    return pair if off_m <= SQUARE_M else None


def _far_level(towards: Side, away: Side, tyres: _NearTyres) -> Optional[float]:
    """Return the level of the inner faces of the far tyres, m outwards of the near side, or None.

    None means that no matching faces exist, or that the outer ones were seen. Only the next level is tried, because
    tyres of a neighbour may be behind the far ones.
    """
    level = max((each for each in levels(towards, MAX_LEVELS)
                 if MIN_BETWEEN_M <= tyres.inner_m - each <= MAX_BETWEEN_M), default=None)
    if level is None or _square_pair(towards, level, [tyres.faces]) is None:
        return None
    outer_m = tyres.outer_m - tyres.inner_m - level
    return level if _square_pair(away, outer_m, [tyres.faces]) is None else None


def _with_outer_faces(in_frame: Surfels, near: str, tyres: _NearTyres, inner_m: float) -> Surfels:
    """Return the surfels with the outer faces of the far tyres, each at the tyre width of its axle's near side."""
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
    """Return a mask of the surfels with this direction and level, at about the position of the face."""
    along = in_frame.position[:, 0]
    return ((in_frame.normal @ facing > MIN_COSINE) & (np.abs(in_frame.position @ facing - level_m) <= FACE_DEPTH_M)
            & (along >= face.low_m - SQUARE_M) & (along <= face.high_m + SQUARE_M))
