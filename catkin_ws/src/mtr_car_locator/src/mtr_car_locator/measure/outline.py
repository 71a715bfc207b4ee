"""Outline polygon of the Car: seen parts, completed by its mirror image and its rectangle."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterable, List, Tuple

import numpy as np
from scipy.spatial import ConvexHull

from mtr_core.arrays import FloatArray

from ..rectangle import Point, Rectangle
from ..surfels import Surfels
from .side import ENDS, OUTWARDS

# Parts within this distance beyond the measured side still belong to the Car, such as a mirror or a tow bar.
PROTRUSION_M = 0.25
# Corners with a smaller bend are removed.
MIN_BEND_M = 0.003


def outline_of(surfels: Surfels, car: Rectangle, seen: Iterable[str]) -> Tuple[Point, ...]:
    """Return the counterclockwise convex polygon round the Car's surfels, which are in its frame.

    A Car is symmetric.
    """
    ends = surfels.ends()
    ends = ends[car.outside(ends) <= PROTRUSION_M]
    points = np.vstack((ends, ends * (1.0, -1.0), *(_edge(name, car) for name in OUTWARDS)))
    unseen = [name for name in OUTWARDS if name not in seen]
    if unseen:
        points = np.vstack((points, *(_whole_edge(name, car) for name in unseen)))
    corners = points[ConvexHull(points).vertices]
    return tuple((float(x), float(y)) for x, y in _simplified(corners.tolist()))


def rounded(car: Rectangle, margin_m: float) -> Tuple[Point, ...]:
    """Return the outline of a Car that is known by its rectangle only."""
    return tuple(car.outline(margin_m))


def _edge(name: str, car: Rectangle) -> FloatArray:
    """Return a short piece in the middle of a side, so that the outline reaches every measured side."""
    return _piece(name, car, 0.1)


def _whole_edge(name: str, car: Rectangle) -> FloatArray:
    return _piece(name, car, 1.0)


def _piece(name: str, car: Rectangle, share: float) -> FloatArray:
    x, y = 0.5 * car.length, 0.5 * car.width
    across = (0.0, share * y) if name in ENDS else (share * x, 0.0)
    middle = np.multiply(OUTWARDS[name], (x, y))
    return np.array([middle - across, middle + across])


def _simplified(corners: List[List[float]]) -> List[List[float]]:
    """Remove the corners with the smallest bends, the flattest first."""
    kept = list(corners)
    while len(kept) > 8:
        bends = [_bend(kept[index - 1], kept[index], kept[(index + 1) % len(kept)]) for index in range(len(kept))]
        flattest = min(range(len(kept)), key=bends.__getitem__)
        if bends[flattest] >= MIN_BEND_M:
            break
        del kept[flattest]
    return kept


def _bend(before: List[float], corner: List[float], after: List[float]) -> float:
    """Return the distance of a corner from the line between its neighbours."""
    dx, dy = after[0] - before[0], after[1] - before[1]
    cross = dx * (corner[1] - before[1]) - dy * (corner[0] - before[0])
    return abs(cross) / max(math.hypot(dx, dy), 1e-9)
