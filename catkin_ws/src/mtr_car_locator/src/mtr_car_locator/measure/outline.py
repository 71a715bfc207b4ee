"""The Car's outline as a polygon: what was seen of it, and where nothing was seen its rectangle or mirror image."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterable, List, Tuple

import numpy as np
from scipy.spatial import ConvexHull

from mtr_core.arrays import FloatArray

from ..rectangle import Point, Rectangle
from ..surfels import Surfels
from .side import ENDS, OUTWARDS

# What reaches so far beyond the measured side is still the Car's: a mirror or a tow bar.
PROTRUSION_M = 0.25
# Corners that bend the outline less are left out.
MIN_BEND_M = 0.003


def outline_of(surfels: Surfels, car: Rectangle, seen: Iterable[str]) -> Tuple[Point, ...]:
    """Counterclockwise convex polygon round the Car's surfels, which are in its frame. A Car is symmetric."""
    ends = surfels.ends()
    ends = ends[car.outside(ends) <= PROTRUSION_M]
    points = np.vstack((ends, ends * (1.0, -1.0), *(_edge(name, car) for name in OUTWARDS)))
    unseen = [name for name in OUTWARDS if name not in seen]
    if unseen:
        points = np.vstack((points, *(_whole_edge(name, car) for name in unseen)))
    corners = points[ConvexHull(points).vertices]
    return tuple((float(x), float(y)) for x, y in _simplified(corners.tolist()))


def rounded(car: Rectangle, margin_m: float) -> Tuple[Point, ...]:
    """Outline of a Car of which nothing but its rectangle is known."""
    return tuple(car.outline(margin_m))


def _edge(name: str, car: Rectangle) -> FloatArray:
    """A short piece in the middle of a side, so that the outline reaches every measured side."""
    return _piece(name, car, 0.1)


def _whole_edge(name: str, car: Rectangle) -> FloatArray:
    return _piece(name, car, 1.0)


def _piece(name: str, car: Rectangle, share: float) -> FloatArray:
    x, y = 0.5 * car.length, 0.5 * car.width
    across = (0.0, share * y) if name in ENDS else (share * x, 0.0)
    middle = np.multiply(OUTWARDS[name], (x, y))
    return np.array([middle - across, middle + across])


def _simplified(corners: List[List[float]]) -> List[List[float]]:
    """Without the corners at which the outline hardly bends, the flattest first."""
    kept = list(corners)
    while len(kept) > 8:
        bends = [_bend(kept[index - 1], kept[index], kept[(index + 1) % len(kept)]) for index in range(len(kept))]
        flattest = min(range(len(kept)), key=bends.__getitem__)
        if bends[flattest] >= MIN_BEND_M:
            break
        del kept[flattest]
    return kept


def _bend(before: List[float], corner: List[float], after: List[float]) -> float:
    """Distance of a corner from the line between its neighbours."""
    dx, dy = after[0] - before[0], after[1] - before[1]
    cross = dx * (corner[1] - before[1]) - dy * (corner[0] - before[0])
    return abs(cross) / max(math.hypot(dx, dy), 1e-9)
