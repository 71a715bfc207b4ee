"""Two tests in one picture: the points of one distance of both, on the lines that both have."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.picture import PointRole, PointSet, Stretch, bars_along, intervals_along
from mtr_operator.history.comparison import Comparison
from mtr_operator.history.line_pairs import LinePair

from ..i18n import translate
from ..pictures.layers.car_layer import CarLayer
from ..pictures.layers.layer import Layer
from ..pictures.layers.lines_layer import LinesLayer
from ..pictures.layers.points_layer import AreasLayer, PointsLayer
from ..pictures.layers.surroundings import GridLayer, ScaleLayer


def overlay(comparison: Comparison, word: str) -> tuple[PointSet, PointSet]:
    """Points of a distance in the first test and in the second one."""
    pairs = _pairs(comparison, word)
    index = comparison.first.scenario.distance_words.index(word)
    first = _points([(pair, pair.first) for pair in pairs], index, PointRole.FIRST,
                    translate("Comparison", "First test"))
    second = _points([(pair, pair.second) for pair in pairs], index, PointRole.SECOND,
                     translate("Comparison", "Second test"))
    return first, second


def overlay_layers(comparison: Comparison, word: str) -> tuple[Sequence[Layer], PointsLayer]:
    """Layers from low to high, and the one of the points."""
    sets = overlay(comparison, word)
    reach_m = 1.0 + max((distance.distance_m for pair in _pairs(comparison, word)
                         for result in (pair.first, pair.second) for distance in result.distances
                         if distance.distance_m is not None), default=0.0)
    stretches = [Stretch(pair.ray.point(0.0), pair.ray.point(reach_m), str(pair.number))
                 for pair in _pairs(comparison, word)]
    points = PointsLayer(sets)
    return (GridLayer(), LinesLayer(stretches), AreasLayer(sets),
            CarLayer(comparison.first.progress.measured_car, True), points, ScaleLayer()), points


def _pairs(comparison: Comparison, word: str) -> list[LinePair]:
    return [difference.pair for difference in comparison.differences if difference.word == word]


def _points(lines: Sequence[tuple[LinePair, LineResult]], index: int, role: PointRole, label: str) -> PointSet:
    measured = [(pair.ray, result.distances[index]) for pair, result in lines]
    points: tuple[Point | None, ...] = tuple(None if distance.distance_m is None else ray.point(distance.distance_m)
                                             for ray, distance in measured)
    return PointSet(label, role, points, is_outline=True, bars=bars_along(measured),
                    intervals=intervals_along(measured))
