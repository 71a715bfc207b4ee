"""LiDAR points around the Car, thinned to one mean and a count per cell."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import numpy as np

CELL_M = 0.02
HALF_SIDE_M = 5.0
# A cell that was hit less often is dirt in the air or the edge of a beam.
LEAST_HITS = 2


class PointGrid:
    """Square of cells about a centre in map."""

    def __init__(self, x: float, y: float):
        self._origin = np.array([x - HALF_SIDE_M, y - HALF_SIDE_M])
        self._side = round(2.0 * HALF_SIDE_M / CELL_M)
        self._hits = np.zeros(self._side ** 2)
        self._sums = np.zeros((self._side ** 2, 2))

    def add(self, points: np.ndarray) -> None:
        """Take points (n, 2) in map; those outside of the square do not count."""
        cells = np.floor((points - self._origin) / CELL_M).astype(int)
        inside = np.all((cells >= 0) & (cells < self._side), axis=1)
        index = cells[inside, 0] * self._side + cells[inside, 1]
        np.add.at(self._hits, index, 1.0)
        np.add.at(self._sums, index, points[inside])

    def points(self) -> Tuple[np.ndarray, np.ndarray]:
        """Mean position (n, 2) and hits (n) of each cell that was hit often enough."""
        index = np.nonzero(self._hits >= LEAST_HITS)[0]
        hits = self._hits[index]
        return self._sums[index] / hits[:, np.newaxis], hits
