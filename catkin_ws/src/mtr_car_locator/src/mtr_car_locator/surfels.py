"""Short straight pieces of surface that LiDARs have seen, in one frame."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, fields
from typing import Tuple, Union

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray, IntArray
from mtr_core.se2 import Pose2

# Surface is counted in pieces of this length.
SAMPLE_M = 0.01


@dataclass(frozen=True)
class Surfels:
    """Arrays with one entry per surfel.

    Attributes:
        position: middle (n, 2), m.
        normal: unit vector (n, 2) towards the side that it was seen from.
        length: along the surface, m.
        sigma: 1 sigma along the normal, m.
        hits: beams that it was made from.
    """

    position: FloatArray
    normal: FloatArray
    length: FloatArray
    sigma: FloatArray
    hits: FloatArray

    def __len__(self) -> int:
        return len(self.length)

    def where(self, index: Union[BoolArray, IntArray]) -> "Surfels":
        """Those that an index array or a mask selects."""
        return Surfels(self.position[index], self.normal[index], self.length[index], self.sigma[index],
                       self.hits[index])

    def in_frame(self, pose: Pose2) -> "Surfels":
        """The same in the frame of the pose."""
        return Surfels(in_frame(self.position, pose), rotated_back(self.normal, pose.heading), self.length, self.sigma,
                       self.hits)

    def ends(self) -> FloatArray:
        """Both ends of each (2n, 2)."""
        half = 0.5 * self.length[:, np.newaxis] * self._tangent()
        return np.vstack((self.position - half, self.position + half))

    def samples(self) -> Tuple[FloatArray, IntArray]:
        """Points (m, 2) along the surfaces, one per centimetre, and for each the index of its surfel."""
        count = np.maximum(np.rint(self.length / SAMPLE_M).astype(int), 1)
        index = np.repeat(np.arange(len(self)), count)
        number = np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)
        along = ((number + 0.5) / count[index] - 0.5) * self.length[index]
        return self.position[index] + along[:, np.newaxis] * self._tangent()[index], index

    def _tangent(self) -> FloatArray:
        return np.column_stack((-self.normal[:, 1], self.normal[:, 0]))


def joined(*parts: Surfels) -> Surfels:
    """All of them together."""
    return Surfels(*(np.concatenate([getattr(part, each.name) for part in parts]) for each in fields(Surfels)))


def surfels_from(columns: FloatArray) -> Surfels:
    """Surfels from columns x, y, normal (rad), length, sigma, hits; rows that are not finite or have no length go."""
    table = np.asarray(columns, dtype=float).reshape(-1, 6)
    table = table[np.all(np.isfinite(table), axis=1) & (table[:, 3] > 0.0) & (table[:, 4] > 0.0)]
    normal = np.column_stack((np.cos(table[:, 2]), np.sin(table[:, 2])))
    return Surfels(table[:, :2], normal, table[:, 3], table[:, 4], table[:, 5])


def in_frame(points: FloatArray, pose: Pose2) -> FloatArray:
    """Coordinates of points (n, 2) in the frame of the pose."""
    return rotated_back(points - (pose.x, pose.y), pose.heading)


def rotated_back(vectors: FloatArray, heading_rad: float) -> FloatArray:
    """Components of vectors (n, 2) in a frame with that heading."""
    cos, sin = np.cos(heading_rad), np.sin(heading_rad)
    return np.column_stack((cos * vectors[:, 0] + sin * vectors[:, 1], -sin * vectors[:, 0] + cos * vectors[:, 1]))
