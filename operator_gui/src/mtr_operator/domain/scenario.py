"""What a test scenario is: parameters, lines to measure, how one is measured, and what the protocol shows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Generator, Generic, Protocol, Sequence, TypeVar

from .actions.car import Car
from .actions.robot import Robot
from .actions.tolerances import Tolerances
from .forecast import Forecast
from .geometry.ray import Ray
from .ports import LockFacts
from .results.line_result import LineResult
from .results.picture import Picture
from .results.quantity import Quantity
from .robot_status import CarDimensions


class ScenarioParameters(Tolerances):
    """What runner and preview need of every scenario's parameters; m and m/s."""

    minimum_distance_m: float
    maximum_distance_m: float
    key_height_m: float
    maximum_speed_mps: float


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

    def concluded(self, parameters: Parameters, results: Sequence[Result]) -> Sequence[Result]:
        """Those results that read otherwise now that all lines are measured, for what lines have in common; none by
        default. The same results give the same answer."""
        return ()

    def check_means(self, car: Car) -> None:
        """Raise an OperatorError, before the robot moves, when something is missing that only this scenario needs."""

    def measure_further(self, line: AnyLine, parameters: Parameters, robot: Robot, car: Car,
                        so_far: Result) -> Result | None:
        """Make the interval of a measured line narrower by more attempts; None when more would not make it so."""
        return None

    def share_of_most(self, parameters: Parameters, result: Result) -> float | None:
        """Of the most attempts that measure_further allows a line, those that its result rests on; None where it is
        not measured further, the default."""
        return None

    def looked(self, parameters: Parameters, results: Sequence[Result], number: int) -> Generator[None, None, Result]:
        """The result of a line whose looks have changed, with its intervals at the level of the last one. A part of
        the work with each step, for the robot waits for no long one."""
        yield from ()
        return next(result for result in results if result.number == number)

    def cautions(self, parameters: Parameters, facts: LockFacts) -> Sequence[str]:
        """Sentences, before the start, on what these parameters cannot give on a Car with these facts; none by
        default."""
        return ()

    def can_go_on(self, line: AnyLine, parameters: Parameters, robot: Robot, car: Car) -> bool:
        """True when measure can finish a line from where the robot stands, with what Robot.kept has of it."""
        return False

    def summary(self, results: Sequence[Result]) -> Sequence[tuple[str, str]]:
        """What all lines together say, a name and a text each, for report and window; nothing by default."""
        return ()

    @abstractmethod
    def picture(self, parameters: Parameters, car: CarDimensions, results: Sequence[Result]) -> Picture:
        """What the protocol shows."""

    def distance_range(self, parameters: Parameters) -> tuple[float, float]:
        """Nearest and farthest distance of the Remote key on each line, in m, for a preview before the test."""
        return parameters.minimum_distance_m, parameters.maximum_distance_m

    def judged_shares(self, parameters: Parameters) -> tuple[int, ...]:
        """Shares of attempts, in percent, for whose distances the results have 95 % intervals; a limits file may ask
        for them."""
        return ()

    def judged_quantities(self, parameters: Parameters) -> tuple[Quantity, ...]:
        """What else a limits file may ask for, beside distances."""
        return ()

    def unreached(self, parameters: Parameters, result: Result, word: str) -> tuple[float | None, float | None]:
        """Between which distances a boundary of a line lies that was not reached; None for an end that nobody knows."""
        return None, parameters.minimum_distance_m

    def measurand(self, parameters: Parameters, result: Result, word: str) -> str:
        """What a measured distance of a line is where it is not the boundary itself, the same text for the same; only
        distances of one measurand are compared. Empty for a boundary, the default."""
        return ""

    def forecast(self, parameters: Parameters, facts: LockFacts, results: Sequence[Result]) -> Forecast | None:
        """What each line is likely to take and to tell, with what the lines so far say; None without a model of it."""
        return None

    def expected_line_s(self, parameters: Parameters) -> float:
        """How long measuring one line is likely to take, in s of robot time, without the way to its start."""
        near_m, far_m = self.distance_range(parameters)
        return (far_m - near_m) / parameters.maximum_speed_mps


# A scenario whatever it measures: for those that run, show and store any of them.
AnyScenario = Scenario[Any, Any, Any]
