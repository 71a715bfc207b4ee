"""Where a Car may stand that does not stand where it stood: its whole shape laid beside its place."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

# Somebody pushes a Car along, or parks it anew: so far it may have moved and still be near its place.
ALONG_M, ACROSS_M = 3.0, 1.0
STEP_M = 0.1
# Returns of a Car that stands where it is said to, which no surface of it explains: persons beside it, doors, what was
# not seen on the way round. Of fewer than this share nothing is asked.
UNEXPLAINED_SHARE = 0.15
# So many points, evenly chosen, tell as much.
MAX_POINTS = 150
# How many of some points (n, 2), seen from viewers (n, 2), lie on the Car when it has moved so (x, y, heading).
Explained = Callable[[FloatArray, FloatArray, FloatArray], int]


def place_beside(points: FloatArray, viewer: FloatArray, explained: Explained) -> Optional[FloatArray]:
    """Motion (x, y, heading) that explains the most points, to some cm; None when none is better than to stand.

    points: in the Car's frame, as is viewer, from where each was seen.
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
    """Motions without a turn, the nearest first: of two that explain as much the nearer counts."""
    along = np.arange(-ALONG_M, ALONG_M + 0.5 * STEP_M, STEP_M)
    across = np.arange(-ACROSS_M, ACROSS_M + 0.5 * STEP_M, STEP_M)
    return tuple(sorted((np.array((x, y, 0.0)) for x in along for y in across),
                        key=lambda motion: math.hypot(motion[0], motion[1])))
