"""Layers of a protocol: the same ones on the screen and in files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.picture import Picture, Stretch
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.assessed import assess

from ..names import domain_word
from .layers.car_layer import CarLayer
from .layers.layer import Layer
from .layers.lines_layer import LinesLayer
from .layers.points_layer import AreasLayer, PointsLayer
from .layers.surroundings import GridLayer, ScaleLayer


@dataclass(frozen=True)
class Protocol:
    """What a finished test has measured."""

    scenario: AnyScenario
    parameters: ScenarioParameters
    progress: Progress

    @functools.cached_property
    def assessment(self) -> Assessment:
        """Budgets of the distances, and the verdicts where there are limits."""
        return assess(self.scenario, self.parameters, self.progress)

    @functools.cached_property
    def picture(self) -> Picture:
        """All lines and points."""
        return self.scenario.picture(self.parameters, self.progress.measured_car, self.progress.results)

    @functools.cached_property
    def points_of_results(self) -> Sequence[tuple[Point, ...]]:
        """Points of each result that are on the picture, m in the Car coordinate system."""
        # An outline that a result alone would have need not be there.
        shown = {point for each in self.picture.point_sets for point in each.known}
        pictures = (self.scenario.picture(self.parameters, self.progress.measured_car, [result])
                    for result in self.progress.results)
        return [tuple(point for each in picture.point_sets for point in each.known if point in shown)
                for picture in pictures]

    def computed(self) -> Picture:
        """The picture, with the points of the results kept beside it: of many zones that takes seconds, in a thread."""
        _ = self.points_of_results
        return self.picture

    def reason_of(self, index: int) -> str:
        """Why a line is invalid, or did not pass; empty for one of which there is nothing to say."""
        result, judgement = self.progress.results[index], self.assessment.judgement
        return result.reason or ("" if judgement is None else judgement.reason_of(result.number))


class ProtocolPicture:
    """Attributes: protocol: what is shown. layers: from low to high. points: the layer with what was measured.
    is_complete: it and all others are filled."""

    def __init__(self, protocol: Protocol, picture: Picture | None = None):
        """picture: of the protocol; None: it is taken later, and only the Car is shown until then."""
        self.protocol = protocol
        self._lines, self._areas = LinesLayer(), AreasLayer()
        self.points = PointsLayer(shows_figures=True)
        self.is_complete = False
        self.layers: Sequence[Layer] = (GridLayer(), self._lines, self._areas,
                                        CarLayer(protocol.progress.measured_car, True), self.points, ScaleLayer())
        if picture is not None:
            self.take(picture)

    def take(self, picture: Picture) -> None:
        """Show the lines and points, which have been computed."""
        self._lines.stretches = tuple(Stretch(stretch.start, stretch.end, domain_word(stretch.label))
                                      for stretch in picture.stretches)
        self._areas.sets = self.points.sets = picture.point_sets
        self.is_complete = True

    def points_of(self, index: int) -> tuple[Point, ...]:
        """Points of one result that are shown."""
        return self.protocol.points_of_results[index] if self.is_complete else ()

    def nearest(self, x: float, y: float, limit_m: float) -> int | None:
        """Index of the result with the point nearest to this place (m), None where none is within limit_m."""
        distances = [(math.dist((x, y), point), index) for index in range(len(self.protocol.progress.results))
                     for point in self.points_of(index)]
        nearest_m, found = min(distances, default=(math.inf, -1))
        return found if nearest_m <= limit_m else None
