"""Search for the place of a moved Car near its old one, by the whole shape."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

# Search range: a Car may be pushed along or parked again nearby.
ALONG_M, ACROSS_M = 3.0, 1.0
STEP_M = 0.1
# Share of unexplained returns for a Car at its place: persons next to it, doors, parts that were not seen before. The
# search requires a larger share.
UNEXPLAINED_SHARE = 0.15
# Number of evenly selected points, which is sufficient.
MAX_POINTS = 150
# Number of points (n, 2), seen from viewers (n, 2), that are on the Car after a motion (x, y, heading).
Explained = Callable[[FloatArray, FloatArray, FloatArray], int]


def place_beside(points: FloatArray, viewer: FloatArray, explained: Explained) -> Optional[FloatArray]:
    """Return the motion (x, y, heading) that explains the most points, to some cm; None if no motion is best.

    points and viewer (the viewpoint of each) are in the Car's frame.
    """
    rows = np.linspace(0, len(points) - 1, min(len(points), MAX_POINTS)).astype(int)
    points, viewer = points[rows], viewer[rows]
    best, most = None, explained(points, viewer, np.zeros(3))
    if most >= (1.0 - UNEXPLAINED_SHARE) * len(points):
        return None
    for motion in _ways():
        count = explained(points, viewer, motion)
        if count > most:
            best, most = motion, count
    return best


def _ways() -> Tuple[FloatArray, ...]:
    """Return motions without a turn, the nearest first, which wins among equal ones."""
    along = np.arange(-ALONG_M, ALONG_M + 0.5 * STEP_M, STEP_M)
    across = np.arange(-ACROSS_M, ACROSS_M + 0.5 * STEP_M, STEP_M)
    return tuple(sorted((np.array((x, y, 0.0)) for x in along for y in across),
                        key=lambda motion: math.hypot(motion[0], motion[1])))
