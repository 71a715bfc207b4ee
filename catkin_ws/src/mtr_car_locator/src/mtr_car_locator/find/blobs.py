"""Initial guess from one place for a Car that the LiDARs look under: parts of three or four wheels are visible."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from typing import Iterator, List, Optional

import numpy as np
from scipy.cluster.hierarchy import fcluster, linkage

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

from ..measure.overhangs import FRONT_SHARE, REAR_SHARE
from ..measure.wheels import MAX_WHEELBASE_M, MIN_WHEELBASE_M
from ..parameters import LocatorParameters
from ..rectangle import Rectangle
from ..surfels import Surfels, in_frame
from .candidates import is_allowed, near
from .prior import Prior

# Parts of a wheel are within this distance; a wheel is larger than a leg and smaller than a sill.
LINK_M = 0.3
MIN_WHEEL_M, MAX_WHEEL_M = 0.1, 0.95
MIN_TRACK_M, MAX_TRACK_M = 1.2, 1.9
# Largest offset between the centre of the visible part of a wheel and the centre of the wheel.
OFF_M = 0.4


def guess_from_blobs(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> Optional[Rectangle]:
    """Return the Car whose wheels the blobs may be, nearest to the prior; None if there is none."""
    blobs = in_frame(_blobs(near(surfels, prior, parameters)), prior.car.pose)
    cars = (Rectangle(prior.car.pose @ at.pose, at.length, at.width) for at in _cars(blobs, parameters))
    found = [car for car in cars if is_allowed(car, prior, parameters)]
    return min(found, key=lambda car: prior.error_of(car.pose)[0]) if found else None


def _blobs(surfels: Surfels) -> FloatArray:
    """Return the centres (n, 2) of objects with the size of a wheel."""
    if len(surfels) < 2:
        return np.empty((0, 2))
    labels = fcluster(linkage(surfels.position, "single"), LINK_M, "distance")
    middles = []
    for label in np.unique(labels):
        mine = surfels.where(labels == label)
        span = np.ptp(mine.ends(), axis=0)
        if MIN_WHEEL_M <= math.hypot(*span) <= MAX_WHEEL_M:
            middles.append(0.5 * (mine.ends().min(axis=0) + mine.ends().max(axis=0)))
    return np.array(middles).reshape(-1, 2)


def _cars(blobs: FloatArray, parameters: LocatorParameters) -> Iterator[Rectangle]:
    """Yield rectangles, in the frame of the blobs, with two wheels on one side and one opposite."""
    for rear, front in itertools.permutations(blobs, 2):
        wheelbase, heading = math.hypot(*(front - rear)), math.atan2(*(front - rear)[::-1])
        if (not MIN_WHEELBASE_M <= wheelbase <= MAX_WHEELBASE_M
                or abs(heading) > parameters.heading_tolerance_rad):
            continue
        frame, length = Pose2(rear[0], rear[1], heading), (1.0 + FRONT_SHARE + REAR_SHARE) * wheelbase
        for track in _tracks(in_frame(blobs, frame).tolist(), wheelbase):
            yield Rectangle(frame @ Pose2(0.5 * wheelbase, 0.5 * track, 0.0), length,
                            parameters.sheet.width_m)


def _tracks(blobs: List[List[float]], wheelbase: float) -> Iterator[float]:
    """Yield the lateral distances of blobs next to one of the axles, positive to the left."""
    for along, across in blobs:
        if min(abs(along), abs(along - wheelbase)) <= OFF_M and MIN_TRACK_M <= abs(across) <= MAX_TRACK_M:
            yield across
