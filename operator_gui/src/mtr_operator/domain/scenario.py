"""What a test scenario is: parameters, lines to measure, how one is measured, and what the protocol shows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Dict, Generic, Sequence, TypeVar

from .actions.car import Car
from .actions.distance import Distance
from .actions.robot import Robot
from .parameters import ParameterSet
from .ports import CarDimensions
from .results.picture import Picture

Parameters = TypeVar("Parameters", bound=ParameterSet)
Line = TypeVar("Line")

# Values of one measured line by column, None where nothing was measured, and the reason of an invalid one.
Result = Dict[str, Any]
REASON = "reason"


class LineStatus(enum.Enum):
    """What became of a measurement."""

    OK = "ok"
    NOT_REACHED = "not_reached"
    INVALID = "invalid"


@dataclass(frozen=True)
class Column:
    """One column of results.csv. digits: decimals of a float."""

    name: str
    unit: str
    doc: str
    digits: int = 4


@dataclass(frozen=True)
class Measurement:
    """One distance of a line.

    word: what it is called beside the line, "unlock". status, distance, uncertainty (1 sigma): its columns.
    """

    word: str
    status: str
    distance: str
    uncertainty: str


class Scenario(ABC, Generic[Parameters, Line]):
    """One kind of test. Stateless: everything it needs is handed in.

    Attributes:
        name: in files and on the command line.
        title: as a person reads it.
        line_word: what a line is called, "axis"; also the name of the first column, which numbers the lines from 1.
        parameters_type: its ParameterSet. It has to have key_height_m and maximum_speed_mps.
        columns: of results.csv.
        measurements: distances of a line, in the order of being measured.
        lines_stay: the lines do not depend on the Car's size, so that they may be shown while it is still refined.
    """

    name: str
    title: str
    line_word: str
    parameters_type: type[Parameters]
    columns: tuple[Column, ...]
    measurements: tuple[Measurement, ...]
    lines_stay: bool = False

    @abstractmethod
    def lines(self, parameters: Parameters, car: CarDimensions) -> list[Line]:
        """Lines to measure, in order; InvalidParameter when they do not suit a Car of this size."""

    @abstractmethod
    def measure(self, line: Line, parameters: Parameters, robot: Robot, car: Car) -> Result:
        """Measure one line. A line that cannot be measured has the status invalid and a reason."""

    @abstractmethod
    def picture(self, parameters: Parameters, car: CarDimensions, results: Sequence[Result]) -> Picture:
        """What the protocol shows."""

    @abstractmethod
    def place_of(self, result: Result) -> str:
        """Where the line of a result lies, for a person: "front right", "45°"."""

    def distance_range(self, parameters: Parameters) -> tuple[float, float]:
        """Nearest and farthest distance of the Remote key on each line, in m, for a preview before the test."""
        return parameters.minimum_distance_m, parameters.maximum_distance_m

    def expected_line_s(self, parameters: Parameters) -> float:
        """How long measuring one line is likely to take, in s of robot time, without the way to its start."""
        near_m, far_m = self.distance_range(parameters)
        return (far_m - near_m) / parameters.maximum_speed_mps

    @property
    def status_columns(self) -> tuple[str, ...]:
        """Columns that hold a LineStatus."""
        return tuple(measurement.status for measurement in self.measurements)

    def number_of(self, result: Result) -> int:
        """Number of the line that a result belongs to."""
        return result[self.line_word]

    def invalid_count(self, result: Result) -> int:
        """How many of the measurements of a line are invalid."""
        return sum(result[column] == LineStatus.INVALID.value for column in self.status_columns)


def distance_values(distance: Distance) -> tuple[float, Any, float]:
    """Distance, uncertainty and robot time as they are recorded; an uncertainty that is not known is None."""
    known = distance.uncertainty_m == distance.uncertainty_m
    return (round(distance.distance_m, 6), round(distance.uncertainty_m, 6) if known else None,
            round(distance.robot_time_s, 6))
