"""Heading of a rectangle from points on its sides."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Sequence

import numpy as np

from mtr_core.se2 import Pose2

from .cluster import in_frame
from .profile import Profile
from .rectangle import Rectangle

# The starting place is good to 5 deg as seen from the robot, and so is the heading it gives the Car.
SEARCH_RAD = math.radians(20.0)
COARSE_RAD, FINE_RAD = math.radians(1.0), math.radians(0.1)
# Points nearer to a side than this all count the same.
NEAREST_M = 0.03
EDGE_QUANTILES = (0.01, 0.99)
# The ends of a side bend towards the bumpers.
ENDS_M = 0.5
LINE_SIGMA_M = 0.01
ROUNDS = 8


def search_heading(points: np.ndarray, prior: Rectangle) -> float:
    """Angle to turn the prior by, by search: most points lie close to one of the sides (closeness criterion)."""
    coarse = _best(points, prior, np.arange(-SEARCH_RAD, SEARCH_RAD + 1e-9, COARSE_RAD))
    return _best(points, prior, coarse + np.arange(-COARSE_RAD, COARSE_RAD + 1e-9, FINE_RAD))


def _best(points: np.ndarray, prior: Rectangle, angles: np.ndarray) -> float:
    return float(max(angles, key=lambda angle: _closeness(points, prior.turned_by(angle).pose)))


def _closeness(points: np.ndarray, pose: Pose2) -> float:
    in_car = in_frame(points, pose)
    low, high = np.quantile(in_car, EDGE_QUANTILES, axis=0)
    to_side = np.minimum(np.abs(in_car - low), np.abs(high - in_car)).min(axis=1)
    return float(np.sum(1.0 / np.maximum(to_side, NEAREST_M)))


def slope_of_sides(left: Profile, right: Profile, length: float) -> float:
    """Common slope of both long sides in the Car's frame, by robust regression; 0 when they tell nothing."""
    rows, values = [], []
    for number, (side, sign) in enumerate(((left, 1.0), (right, -1.0))):
        middle = np.abs(side.along) < 0.5 * length - ENDS_M
        if np.count_nonzero(middle) >= 6:
            own = [np.full(np.count_nonzero(middle), 1.0 if number == k else 0.0) for k in (0, 1)]
            rows.append(np.column_stack((side.along[middle], *own)))
            values.append(sign * side.outward[middle])
    if not rows:
        return 0.0
    return _robust_slope(np.vstack(rows), np.concatenate(values), [k for k in (0, 1, 2)])


def _robust_slope(matrix: np.ndarray, values: np.ndarray, columns: Sequence[int]) -> float:
    used = [k for k in columns if np.any(matrix[:, k] != 0.0)]
    weights = np.ones(len(values))
    slope = 0.0
    for _ in range(ROUNDS):
        solution = np.linalg.lstsq(matrix[:, used] * weights[:, np.newaxis], values * weights, rcond=None)[0]
        rest = values - matrix[:, used] @ solution
        weights = 1.0 / np.sqrt(1.0 + (rest / LINE_SIGMA_M) ** 2)
        slope = float(solution[0])
    return slope
