"""Repeated tests in one picture: the value of each test on its line, and the mean with its 95 % interval."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Sequence

from mtr_operator.domain.results.picture import PointRole, PointSet, Stretch

from ..i18n import translate
from ..pictures.layers.car_layer import CarLayer
from ..pictures.layers.layer import Layer
from ..pictures.layers.lines_layer import LinesLayer
from ..pictures.layers.points_layer import AreasLayer, PointsLayer
from ..pictures.layers.surroundings import GridLayer, ScaleLayer

if TYPE_CHECKING:
    from mtr_operator.history.spread import DistanceSpread, TestSpread

_BEYOND_M = 1.0


def spread_layers(found: TestSpread, word: str) -> tuple[Sequence[Layer], PointsLayer]:
    """Layers from low to high, and the one of the points."""
    distances = found.of(word)
    reach_m = _BEYOND_M + max((value for distance in distances for value in distance.values_m), default=0.0)
    stretches = [Stretch(distance.ray.point(0.0), distance.ray.point(reach_m), str(distance.line.number))
                 for distance in distances]
    sets = _every(distances), _means(distances)
    points = PointsLayer(sets)
    return (GridLayer(), LinesLayer(stretches), AreasLayer(sets),
            CarLayer(found.tests.first.progress.measured_car, True), points, ScaleLayer()), points


def _every(distances: Sequence[DistanceSpread]) -> PointSet:
    return PointSet(translate("Spread", "Each test"), PointRole.UNKNOWN,
                    tuple(distance.ray.point(value) for distance in distances for value in distance.values_m))


def _means(distances: Sequence[DistanceSpread]) -> PointSet:
    known = [(distance.ray, distance.mean.value, distance.mean) for distance in distances]
    points = tuple(None if value is None else ray.point(value) for ray, value, _ in known)
    intervals = tuple((ray.point(mean.low), ray.point(mean.high)) for ray, value, mean in known
                      if value is not None and math.isfinite(mean.low) and math.isfinite(mean.high))
    return PointSet(translate("Spread", "Mean"), PointRole.FIRST, points, is_outline=True, intervals=intervals)
