"""Map of objects around the Car that the robot has seen repeatedly; objects that have gone are removed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import numpy as np

from mtr_operator.domain.robot_status import RobotStatus

from .view import View

CELL_M = 0.2
_CELLS = 400
_HALF_M = CELL_M * _CELLS / 2.0
# Robot time between two updates: a person who walks by occupies no cell for long.
PERIOD_S = 0.5
# A return counts more than a passing ray, because rays graze surfaces at flat angles. A cell becomes occupied after
# three returns, and free after seven passing rays.
_RETURN, _PASS, _OCCUPIED, _MOST = 2, 1, 6, 12
# The last piece of a ray is ignored: range noise, and its cell's own size.
_UNSURE_M = 0.4


class ObstacleMap:
    """Square of 80 m around the Car's centre. It restarts with another frame of the Car.

    Attributes:
        version: increases with each change of places.
        places: centres of the occupied cells, (n, 2), Car coordinate system, m.
        seen: True at the known cells, occupied or free, as a square of rows along x.
    """

    def __init__(self) -> None:
        self._counts: Any = np.zeros(_CELLS * _CELLS, dtype=np.int8)
        self._frame: tuple[int, int] = (0, 0)
        self._looked_s = -math.inf
        self.version = 0
        self.places: Any = np.empty((0, 2))
        self.seen: Any = np.zeros((_CELLS, _CELLS), dtype=bool)

    @property
    def mark(self) -> tuple[int, int]:
        """Return a mark that changes with the content."""
        return self.version, int(np.count_nonzero(self.seen))

    def has_seen(self, x_m: Any, y_m: Any) -> Any:
        """Return True at places of known cells, or with a known neighbouring cell; rays leave gaps."""
        rows, columns, inside = _indices(x_m, y_m)
        known = np.zeros(len(rows), dtype=bool)
        for row in (-1, 0, 1):
            for column in (-1, 0, 1):
                near = np.clip(rows + row, 0, _CELLS - 1), np.clip(columns + column, 0, _CELLS - 1)
                known |= self.seen[near]
        return known & inside

    def learn(self, status: RobotStatus, view: View) -> None:
        """Add the view of a Status."""
        frame = status.robot_session_id, status.car_frame.revision
        if frame != self._frame or status.car is None or status.stamp_s < self._looked_s:
            self._frame, self._looked_s = frame, -math.inf
            self._counts[:] = 0
            self.seen[:] = False
        if status.car is None or status.stamp_s - self._looked_s < PERIOD_S:
            return
        self._looked_s = status.stamp_s
        self._look(view)

    def _look(self, view: View) -> None:
        counts = self._counts
        passed, met = _cells(*_passed(view)), _cells(*view.points.T)
        counts[passed] = np.maximum(counts[passed] - _PASS, 0)
        counts[met] = np.minimum(counts[met] + _RETURN, _MOST)
        self.seen |= (passed | met).reshape(self.seen.shape)
        rows, columns = np.divmod(np.flatnonzero(counts >= _OCCUPIED), _CELLS)
        places = np.column_stack((rows, columns)) * CELL_M - _HALF_M + CELL_M / 2.0
        if not np.array_equal(places, self.places):
            self.places = places
            self.version += 1


def _passed(view: View) -> tuple[Any, Any]:
    """Return x and y of places along all rays, a cell apart, without their last piece."""
    x_m, y_m = view.points.T - np.array(view.viewer)[:, None]
    lengths_m = np.hypot(x_m, y_m)
    if not len(lengths_m):
        return x_m, y_m
    steps_m = np.arange(0.0, min(float(lengths_m.max()), _HALF_M), CELL_M)
    rays, steps = np.nonzero(steps_m < lengths_m[:, None] - _UNSURE_M)
    parts = steps_m[steps] / lengths_m[rays]
    return view.viewer[0] + parts * x_m[rays], view.viewer[1] + parts * y_m[rays]


def _cells(x_m: Any, y_m: Any) -> Any:
    """Return True at the cells of places, in the order of the counts; places outside the square are omitted."""
    rows, columns, inside = _indices(x_m, y_m)
    cells = np.zeros(_CELLS * _CELLS, dtype=bool)
    cells[rows[inside] * _CELLS + columns[inside]] = True
    return cells


def _indices(x_m: Any, y_m: Any) -> tuple[Any, Any, Any]:
    """Return rows and columns of places, and True at those within the square."""
    rows, columns = (x_m + _HALF_M) / CELL_M, (y_m + _HALF_M) / CELL_M
    inside = (rows >= 0.0) & (rows < _CELLS) & (columns >= 0.0) & (columns < _CELLS)
    # The conversion rounds non-negative values down.
    return rows.astype(np.int64), columns.astype(np.int64), inside
