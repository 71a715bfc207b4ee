"""Incremental surfels from LiDAR points: the locator's own rough map while the robot drives round the Car."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
from scipy import ndimage

from mtr_core.arrays import FloatArray

from ..surfels import Surfels

CELL_M = 0.08
HALF_SIDE_M = 6.0
# A cell with fewer hits is dirt in the air or the edge of a beam; a shorter one has no direction.
MIN_HITS = 6
MIN_LENGTH_M = 0.02
# A surface along the border of two cells leaves the tail of its noise in one of them, with fewer hits than in the
# neighbour.
MIN_SHARE_OF_NEIGHBOUR = 0.35
# Lower bound of the sigma, for the approximation by a straight piece.
SIGMA_FLOOR_M = 0.002


class SurfelGrid:
    """Square of cells about a centre in map; each stores the moments of its points."""

    def __init__(self, x: float, y: float):
        self._centre = np.array([x, y])
        self._side = round(2.0 * HALF_SIDE_M / CELL_M)
        # Columns: hits, then sums of x, y, xx, xy, yy and of the unit vector towards the LiDAR.
        self._sums = np.zeros((self._side ** 2, 8))

    def add(self, points: FloatArray, viewer: FloatArray) -> None:
        """Add points (n, 2) in map, seen from viewer (2); points outside of the square are ignored."""
        shifted = points - self._centre
        cells = np.floor((shifted + HALF_SIDE_M) / CELL_M).astype(int)
        inside = np.all((cells >= 0) & (cells < self._side), axis=1)
        index = cells[inside, 0] * self._side + cells[inside, 1]
        x, y = shifted[inside].T
        back = viewer - points[inside]
        back /= np.maximum(np.linalg.norm(back, axis=1), 1e-6)[:, np.newaxis]
        columns = (np.ones_like(x), x, y, x * x, x * y, y * y, back[:, 0], back[:, 1])
        for number, values in enumerate(columns):
            self._sums[:, number] += np.bincount(index, weights=values, minlength=len(self._sums))

    def surfels(self, pose_sigma_m: float) -> Surfels:
        """Return one surfel per cell. pose_sigma_m: uncertainty of the robot's position."""
        hits = self._sums[:, 0].reshape(self._side, self._side)
        whole = (hits >= MIN_HITS) & (hits >= MIN_SHARE_OF_NEIGHBOUR * ndimage.maximum_filter(hits, 3))
        sums = self._sums[whole.ravel()]
        hits, mean = sums[:, 0], sums[:, 1:3] / sums[:, :1]
        xx, xy, yy = (sums[:, column] / hits - mean[:, a] * mean[:, b]
                      for column, a, b in ((3, 0, 0), (4, 0, 1), (5, 1, 1)))
        along = 0.5 * np.arctan2(2.0 * xy, xx - yy)
        root = np.hypot(0.5 * (xx - yy), xy)
        long_m2, thin_m2 = 0.5 * (xx + yy) + root, np.maximum(0.5 * (xx + yy) - root, 0.0)
        normal = np.column_stack((-np.sin(along), np.cos(along)))
        normal[np.sum(normal * sums[:, 6:8], axis=1) < 0.0] *= -1.0
        sigma = np.sqrt(thin_m2 / hits + SIGMA_FLOOR_M ** 2 + pose_sigma_m ** 2)
        # A straight piece of length l has the variance l * l / 12 along it.
        found = Surfels(mean + self._centre, normal, np.sqrt(12.0 * long_m2), sigma, hits)
        return found.where(found.length >= MIN_LENGTH_M)
