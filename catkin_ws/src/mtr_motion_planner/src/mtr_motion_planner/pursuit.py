"""Progress along a polyline, and the point ahead on it."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Sequence

from .inputs import Point

# Progress is searched this far ahead, so that a route that comes back near itself is not cut short.
SEARCH_AHEAD_M = 0.6


class Polyline:
    """A polyline that is followed once from its start to its end; progress never goes back."""

    def __init__(self, points: Sequence[Point]):
        self._points = list(points)
        self._starts = [0.0]
        for a, b in zip(points, points[1:]):
            self._starts.append(self._starts[-1] + math.hypot(b[0] - a[0], b[1] - a[1]))
        self._progress = 0.0
        self._segment = 0

    def advance(self, x: float, y: float) -> float:
        """Move progress to the point nearest to (x, y) and return the length that is left, negative beyond the end."""
        best = math.inf
        first, found, progress, overshoot = self._segment, self._segment, self._progress, 0.0
        for index in range(first, len(self._points) - 1):
            if self._starts[index] > self._progress + SEARCH_AHEAD_M:
                break
            along, length = self._along(index, x, y)
            inside = max(0.0, min(length, along))
            px, py = self._at(index, inside)
            distance = math.hypot(x - px, y - py)
            if distance < best:
                best, found, progress = distance, index, self._starts[index] + inside
                overshoot = along - length if index == len(self._points) - 2 and along > length else 0.0
        self._segment, self._progress = found, max(progress, self._progress)
        return self._starts[-1] - self._progress - overshoot

    def ahead(self, distance: float) -> Point:
        """Point at this distance ahead on the line, on the prolonged last segment beyond its end."""
        target = self._progress + distance
        index = self._segment
        while index < len(self._points) - 2 and self._starts[index + 1] < target:
            index += 1
        return self._at(index, target - self._starts[index])

    def _along(self, index: int, x: float, y: float):
        (ax, ay), (bx, by) = self._points[index], self._points[index + 1]
        length = self._starts[index + 1] - self._starts[index]
        return ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / max(length, 1e-9), length

    def _at(self, index: int, along: float) -> Point:
        (ax, ay), (bx, by) = self._points[index], self._points[index + 1]
        share = along / max(self._starts[index + 1] - self._starts[index], 1e-9)
        return ax + share * (bx - ax), ay + share * (by - ay)
