"""Two tests in one picture: the points of one distance of both, on the lines that both have."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import MeasuredDistance
from mtr_operator.domain.results.picture import PointRole, PointSet, Stretch, bars_along, intervals_along
from mtr_operator.history.same_lines import Tests
from mtr_operator.history.statistics.comparison import Comparison
from mtr_operator.history.statistics.row import Row

from ..i18n import translate
from ..pictures.layers.car_layer import CarLayer
from ..pictures.layers.layer import Layer
from ..pictures.layers.lines_layer import LinesLayer
from ..pictures.layers.points_layer import AreasLayer, PointsLayer
from ..pictures.layers.surroundings import GridLayer, ScaleLayer


def overlay(comparison: Comparison, word: str) -> tuple[PointSet, PointSet]:
    """Return the points of a distance in the first test and in the second one."""
    return (_points(comparison, word, 0, PointRole.FIRST, translate("Comparison", "First test")),
            _points(comparison, word, 1, PointRole.SECOND, translate("Comparison", "Second test")))


def overlay_layers(comparison: Comparison, word: str) -> tuple[Sequence[Layer], PointsLayer]:
    """Return the layers from low to high, and the one of the points."""
    tests, sets = comparison.tests, overlay(comparison, word)
    lines = _lines(comparison, word)
    reach_m = 1.0 + max((distance.distance_m for line in lines for _, distance in _measured(tests, line, word)
                         if distance.distance_m is not None), default=0.0)
    stretches = [Stretch(tests.ray(line).point(0.0), tests.ray(line).point(reach_m), str(line)) for line in lines]
    points = PointsLayer(sets)
    return (GridLayer(), LinesLayer(stretches), AreasLayer(sets), CarLayer(tests.first.progress.measured_car, True),
            points, ScaleLayer()), points


def points_of(comparison: Comparison, row: Row) -> tuple[Point, ...]:
    """Return the measured points of a row in both tests, for its first distance."""
    word = shown_word(comparison, row)
    return tuple(ray.point(distance.distance_m) for line in row.lines
                 for ray, distance in _measured(comparison.tests, line, word) if distance.distance_m is not None)


def shown_word(comparison: Comparison, row: Row) -> str:
    """Return the distance by which the picture shows a row."""
    words = comparison.tests.words
    return row.words[0] if row.words[0] in words else words[0]


def _lines(comparison: Comparison, word: str) -> list[int]:
    return [row.lines[0] for row in comparison.distances if row.word == word]


def _measured(tests: Tests, line: int, word: str) -> list[tuple[Ray, MeasuredDistance]]:
    """Return the line and its distance in both tests."""
    index = tests.words.index(word)
    return [(tests.ray(line), results[line].distances[index]) for results in tests.results if line in results]


def _points(comparison: Comparison, word: str, test: int, role: PointRole, label: str) -> PointSet:
    measured = [_measured(comparison.tests, line, word)[test] for line in _lines(comparison, word)]
    points: tuple[Point | None, ...] = tuple(None if distance.distance_m is None else ray.point(distance.distance_m)
                                             for ray, distance in measured)
    return PointSet(label, role, points, is_outline=True, bars=bars_along(measured),
                    intervals=intervals_along(measured))
