"""The Car as a rectangle in map."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

# x and y in m.
Point = Tuple[float, float]

# Distance from the middle line within which directions outwards are undefined; they are computed from there.
CORE_M = 0.6


@dataclass(frozen=True)
class Rectangle:
    """Pose of the Car's centre in map, x to its front, and its length and width in m."""

    pose: Pose2
    length: float
    width: float

    def outline(self, margin_m: float = 0.0) -> List[Point]:
        """Return the corners in the Car's own frame, counterclockwise, grown by the margin on each side."""
        x, y = 0.5 * self.length + margin_m, 0.5 * self.width + margin_m
        return [(x, y), (-x, y), (-x, -y), (x, -y)]

    def outside(self, in_car: FloatArray) -> FloatArray:
        """Return the distance of points in the Car's frame outwards of the nearest side, negative inside."""
        beyond = np.abs(in_car) - (0.5 * self.length, 0.5 * self.width)
        return np.max(beyond, axis=1)

    def outwards(self, in_car: FloatArray) -> FloatArray:
        """Return unit vectors (n, 2) away from the Car at points in its frame; they rotate round the corners."""
        core = np.maximum(np.array([0.5 * self.length, 0.5 * self.width]) - CORE_M, 0.1)
        away = in_car - np.clip(in_car, -core, core)
        return away / np.maximum(np.linalg.norm(away, axis=1), 1e-9)[:, np.newaxis]

    def moved_by(self, motion: Pose2) -> "Rectangle":
        """Return a rectangle of the same size, moved in its own frame."""
        return dataclasses.replace(self, pose=self.pose @ motion)
