"""Surfels: short straight pieces of surface seen by LiDARs, in one frame."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, fields
from typing import Tuple, Union

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray, IntArray
from mtr_core.se2 import Pose2

# Sample length for counting surface.
SAMPLE_M = 0.01


@dataclass(frozen=True)
class Surfels:
    """Arrays with one entry per surfel.

    Attributes:
        position: middle (n, 2), m.
        normal: unit vector (n, 2) towards the side that it was seen from.
        length: along the surface, m.
        sigma: 1 sigma along the normal, m.
        hits: number of beams.
    """

    position: FloatArray
    normal: FloatArray
    length: FloatArray
    sigma: FloatArray
    hits: FloatArray

    def __len__(self) -> int:
        return len(self.length)

    def where(self, index: Union[BoolArray, IntArray]) -> "Surfels":
        """Return the surfels selected by an index array or a mask."""
        return Surfels(self.position[index], self.normal[index], self.length[index], self.sigma[index],
                       self.hits[index])

    def in_frame(self, pose: Pose2) -> "Surfels":
        """Return the surfels in the frame of the pose."""
        return Surfels(in_frame(self.position, pose), rotated_back(self.normal, pose.heading), self.length, self.sigma,
                       self.hits)

    def ends(self) -> FloatArray:
        """Return both ends of each surfel (2n, 2)."""
        half = 0.5 * self.length[:, np.newaxis] * self._tangent()
        return np.vstack((self.position - half, self.position + half))

    def samples(self) -> Tuple[FloatArray, IntArray]:
        """Return points (m, 2) along the surfaces, one per centimetre, and the surfel index of each."""
        count = np.maximum(np.rint(self.length / SAMPLE_M).astype(int), 1)
        index = np.repeat(np.arange(len(self)), count)
        number = np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)
        along = ((number + 0.5) / count[index] - 0.5) * self.length[index]
        return self.position[index] + along[:, np.newaxis] * self._tangent()[index], index

    def _tangent(self) -> FloatArray:
        return np.column_stack((-self.normal[:, 1], self.normal[:, 0]))


def joined(*parts: Surfels) -> Surfels:
    """Concatenate surfels."""
    return Surfels(*(np.concatenate([getattr(part, each.name) for part in parts]) for each in fields(Surfels)))


def surfels_from(columns: FloatArray) -> Surfels:
    """Return surfels from columns x, y, normal (rad), length, sigma, hits; drop rows not finite or empty."""
    table = np.asarray(columns, dtype=float).reshape(-1, 6)
    table = table[np.all(np.isfinite(table), axis=1) & (table[:, 3] > 0.0) & (table[:, 4] > 0.0)]
    normal = np.column_stack((np.cos(table[:, 2]), np.sin(table[:, 2])))
    return Surfels(table[:, :2], normal, table[:, 3], table[:, 4], table[:, 5])


def in_frame(points: FloatArray, pose: Pose2) -> FloatArray:
    """Return coordinates of points (n, 2) in the frame of the pose."""
    return rotated_back(points - (pose.x, pose.y), pose.heading)


def rotated_back(vectors: FloatArray, heading_rad: float) -> FloatArray:
    """Return components of vectors (n, 2) in a frame with that heading."""
    cos, sin = np.cos(heading_rad), np.sin(heading_rad)
    return np.column_stack((cos * vectors[:, 0] + sin * vectors[:, 1], -sin * vectors[:, 0] + cos * vectors[:, 1]))
