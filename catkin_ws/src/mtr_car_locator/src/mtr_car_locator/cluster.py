"""Points that belong together, and which of them are the Car."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import numpy as np
from scipy import ndimage

from mtr_core.se2 import Pose2

from .rectangle import Rectangle

# Points in neighbouring cells of this size are one thing: gaps between wheel, sill and bumper are smaller.
LINK_M = 0.15
# The Car is looked for so far beyond where it is expected.
REACH_M = 1.2
CORE_M = 0.5
LEAST_SHARE_IN_CORE = 0.5


def in_frame(points: np.ndarray, pose: Pose2) -> np.ndarray:
    """Coordinates of points in the frame of the pose."""
    cos, sin = np.cos(pose.heading), np.sin(pose.heading)
    shifted = points - (pose.x, pose.y)
    return np.column_stack((cos * shifted[:, 0] + sin * shifted[:, 1], -sin * shifted[:, 0] + cos * shifted[:, 1]))


def car_points(points: np.ndarray, prior: Rectangle) -> Tuple[np.ndarray, np.ndarray]:
    """Indices of the points that may be the Car, and for each the number of its cluster."""
    near = np.nonzero(_inside(in_frame(points, prior.pose), prior, REACH_M))[0]
    if len(near) == 0:
        return near, near
    labels = _label(points[near])
    core = _inside(in_frame(points[near], prior.pose), prior, CORE_M)
    total = np.bincount(labels)
    share = np.bincount(labels, weights=core) / np.maximum(total, 1)
    keep = share[labels] >= LEAST_SHARE_IN_CORE
    return near[keep], labels[keep]


def _inside(in_car: np.ndarray, rectangle: Rectangle, margin_m: float) -> np.ndarray:
    half = np.array([0.5 * rectangle.length + margin_m, 0.5 * rectangle.width + margin_m])
    return np.all(np.abs(in_car) <= half, axis=1)


def _label(points: np.ndarray) -> np.ndarray:
    cells = np.floor((points - points.min(axis=0)) / LINK_M).astype(int)
    image = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    image[cells[:, 0], cells[:, 1]] = True
    labels, _ = ndimage.label(image, structure=np.ones((3, 3)))
    return labels[cells[:, 0], cells[:, 1]]
