"""What a test scenario is: parameters, lines to measure, how one is measured, and what the protocol shows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Generic, Protocol, Sequence, TypeVar

from .actions.car import Car
from .actions.robot import Robot
from .actions.tolerances import Tolerances
from .geometry.ray import Ray
from .results.line_result import LineResult
from .results.picture import Picture, PointRole, PointSet, Stretch
from .robot_status import CarDimensions


class ScenarioParameters(Tolerances):
    """What runner and preview need of every scenario's parameters; m and m/s."""

    minimum_distance_m: float
    maximum_distance_m: float
    key_height_m: float
    maximum_speed_mps: float

    @property
    def distance_range_m(self) -> tuple[float, float]:
        """Nearest and farthest distance of the Remote key on each line."""
        return self.minimum_distance_m, self.maximum_distance_m


class Line(Protocol):
    """What is measured in one go; number counts from 1."""

    @property
    def number(self) -> int:
        """Number of the line."""

    @property
    def ray(self) -> Ray:
        """Where the Remote key is carried."""


Parameters = TypeVar("Parameters", bound=ScenarioParameters)
AnyLine = TypeVar("AnyLine", bound=Line)
Result = TypeVar("Result", bound=LineResult)


class Scenario(ABC, Generic[Parameters, AnyLine, Result]):
    """One kind of test. Stateless: everything it needs is handed in.

    A scenario runs with `lines` and `measure` alone; interfaces.scenario_parts has what else it may offer.

    Attributes:
        name: in files and on the command line.
        title: as a person reads it.
        line_word: what a line is called, "axis"; also the name of the first column, which numbers the lines from 1.
        parameters_type: its parameters.
        result_type: its results; the columns of results.csv follow from it.
        distance_words: what the distances of a line are called, in the order of being measured.
        announcement: what the Car may do to people next to it in this test, a sentence; empty when nothing.
        lines_stay: the lines do not depend on the Car's size, so that they may be shown while it is still refined.
    """

    name: str
    title: str
    line_word: str
    parameters_type: type[Parameters]
    result_type: type[Result]
    distance_words: tuple[str, ...]
    lines_stay: bool = False
    announcement: str = ""

    @abstractmethod
    def lines(self, parameters: Parameters, car: CarDimensions) -> list[AnyLine]:
        """Lines to measure, in order; InvalidParameter when they do not suit a Car of this size."""

    @abstractmethod
    def measure(self, line: AnyLine, parameters: Parameters, robot: Robot, car: Car) -> Result:
        """Measure one line. A line that cannot be measured has the status invalid and a reason."""

    def picture(self, parameters: Parameters, car: CarDimensions, results: Sequence[Result]) -> Picture:
        """What the protocol shows: by default each line, and each measured distance on it."""
        rays = {line.number: line.ray for line in self.lines(parameters, car)}
        near_m, far_m = parameters.distance_range_m
        stretches = tuple(Stretch(rays[result.number].point(near_m), rays[result.number].point(far_m),
                                  str(result.number)) for result in results)
        return Picture(stretches, tuple(
            PointSet(word.capitalize(), role, tuple(
                rays[result.number].point(distance.distance_m) for result in results for distance in result.distances
                if distance.word == word and distance.distance_m is not None))
            for word, role in zip(self.distance_words, (PointRole.FIRST, PointRole.SECOND))))


# A scenario whatever it measures: for those that run, show and store any of them.
AnyScenario = Scenario[Any, Any, Any]
