"""Distance of the robot's solids from a Car's true body along a path, each within its own heights."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Sequence

import numpy as np

from mtr_core.arrays import FloatArray

from .bodies import Solid

STEP_M = 0.02


class RobotBox(NamedTuple):
    """Box of the robot in base_link, m."""

    rear_m: float
    front_m: float
    half_width_m: float
    low_m: float
    high_m: float


# Dimensions from the robot's description: chassis with wheels and LiDARs; mast of 1.65 m with arm and key at any
# height.
ROBOT_BOXES = (RobotBox(-0.254, 0.254, 0.215, 0.0, 0.45), RobotBox(-0.09, 0.27, 0.03, 0.25, 1.65))


class Body:
    """Solids of a Car, represented by points on their edges."""

    def __init__(self, solids: Sequence[Solid]):
        self._solids = [(solid, _sampled(solid)) for solid in solids]

    def clearance(self, poses: FloatArray) -> float:
        """Return the least distance in m of base_link poses (n, 3) in the Car's frame; 0 for a contact."""
        return min((_distance(box, points, poses) for box in ROBOT_BOXES for solid, points in self._solids
                    if solid.low_m < box.high_m and box.low_m < solid.high_m), default=math.inf)


def _sampled(solid: Solid) -> FloatArray:
    corners = np.array(solid.corners)
    parts: List[FloatArray] = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        steps = max(1, math.ceil(float(np.hypot(*(b - a))) / STEP_M))
        parts.append(a + (b - a) * np.linspace(0.0, 1.0, steps, endpoint=False)[:, None])
    return np.concatenate(parts)


def _distance(box: RobotBox, points: FloatArray, poses: FloatArray) -> float:
    cos, sin = np.cos(poses[:, 2:3]), np.sin(poses[:, 2:3])
    dx, dy = points[:, 0] - poses[:, :1], points[:, 1] - poses[:, 1:2]
    along, across = cos * dx + sin * dy, cos * dy - sin * dx
    ahead = np.maximum(np.maximum(along - box.front_m, box.rear_m - along), 0.0)
    aside = np.maximum(np.abs(across) - box.half_width_m, 0.0)
    return math.sqrt(float((ahead * ahead + aside * aside).min()))
