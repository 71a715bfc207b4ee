"""Interface of kernels, and the result of a test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
import statistics
from dataclasses import dataclass
from typing import Any, Mapping, Protocol

from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineResult, LineStatus
from mtr_operator.domain.results.progress import Progress

from .order import Order

# Smallest number of lines of one height round the Car that enclose an area.
_MIN_CORNERS = 3


class Kernel(Protocol):
    """Simulator of tests.

    Attributes:
        name: of the kernel in plans.
    """

    name: str

    def check(self, order: Order) -> None:
        """Raise CampaignError if the kernel cannot run the order."""

    def run(self, order: Order, folder: pathlib.Path, digest: str) -> Outcome:
        """Run a test with a folder for its files; OperatorError with the reason if it fails."""


@dataclass(frozen=True)
class Outcome:
    """Attributes: figures: of the test, by name. distances: by word and line; None if unknown."""

    figures: dict[str, float]
    distances: dict[str, dict[str, float | None]]

    def to_document(self) -> dict[str, Any]:
        """Plain values."""
        return {"figures": self.figures, "distances": self.distances}


def outcome_of(order: Order, progress: Progress, robot_s: float) -> Outcome:
    """Return the figures of a test: distances in m, areas in m2, and the duration for the robot in s."""
    results, rays = progress.results, _rays(order, progress)
    figures: dict[str, float] = {"robot_s": round(robot_s, 1), "lines": len(results),
                                 "invalid": sum(1 for result in results if result.invalid_count)}
    distances: dict[str, dict[str, float | None]] = {}
    for index, word in enumerate(order.scenario.distance_words):
        distances[word] = {str(result.number): _distance(result, index) for result in results}
        known = [value for value in distances[word].values() if value is not None]
        figures[f"{word}_known"] = len(known)
        if known:
            figures.update({f"{word}_mean_m": statistics.fmean(known), f"{word}_min_m": min(known),
                            f"{word}_max_m": max(known)})
        if len(known) >= _MIN_CORNERS:
            figures[f"{word}_area_m2"] = _area(rays, distances[word])
    return Outcome(figures, distances)


def _rays(order: Order, progress: Progress) -> dict[int, Ray]:
    if progress.car is None:
        return {}
    return {line.number: line.ray for line in order.scenario.lines(order.parameters, progress.car)}


def _distance(result: LineResult, index: int) -> float | None:
    distances = result.distances
    if index >= len(distances) or distances[index].status is not LineStatus.OK:
        return None
    return distances[index].distance_m


def _area(rays: Mapping[int, Ray], distances: Mapping[str, float | None]) -> float:
    """Return the area of the polygon through the points, in the order of their bearings."""
    points = [rays[int(number)].point(value) for number, value in distances.items() if value is not None]
    around = sorted(points, key=lambda point: math.atan2(point[1], point[0]))
    doubled: float = sum(x * next_y - next_x * y for (x, y), (next_x, next_y)
                         in zip(around, [*around[1:], around[0]]))
    return abs(doubled) / 2.0
