"""Layers of a protocol: the same ones on the screen and in files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Sequence

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

    @property
    def picture(self) -> Picture:
        """All lines and points."""
        return self.scenario.picture(self.parameters, self.progress.measured_car, self.progress.results)

    def picture_of(self, index: int) -> Picture:
        """Line and points of one result."""
        return self.scenario.picture(self.parameters, self.progress.measured_car, [self.progress.results[index]])

    def reason_of(self, index: int) -> str:
        """Why a line is invalid, or did not pass; empty for one of which there is nothing to say."""
        result, judgement = self.progress.results[index], self.assessment.judgement
        return result.reason or ("" if judgement is None else judgement.reason_of(result.number))

    def nearest(self, x: float, y: float, limit_m: float) -> int | None:
        """Index of the result with the point nearest to this place (m), None where none is within limit_m."""
        distances = [(math.dist((x, y), point), index) for index in range(len(self.progress.results))
                     for each in self.picture_of(index).point_sets for point in each.known]
        nearest_m, found = min(distances, default=(math.inf, -1))
        return found if nearest_m <= limit_m else None


class ProtocolPicture:
    """Attributes: protocol: what is shown. layers: from low to high. points: the layer with what was measured."""

    def __init__(self, protocol: Protocol):
        self.protocol = protocol
        picture = protocol.picture
        stretches = [Stretch(stretch.start, stretch.end, domain_word(stretch.label)) for stretch in picture.stretches]
        self.points = PointsLayer(picture.point_sets, shows_figures=True)
        self.layers: Sequence[Layer] = (
            GridLayer(), LinesLayer(stretches), AreasLayer(picture.point_sets),
            CarLayer(protocol.progress.measured_car, True),
            self.points, ScaleLayer())
