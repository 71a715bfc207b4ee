"""State of a test that survives the application: what was wanted, and what has been measured so far."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Any

from ..errors import ProgressFileError
from ..ports import CarCheck, CarDimensions
from ..scenario import REASON, LineStatus, Result, Scenario
from .frame_history import KnownFrame
from .frame_record import FrameRecord, record_from

FORMAT = "mtr-operator progress"
VERSION = 1
# A Car that measures this much differently on a later day is another Car.
SAME_CAR_M = 0.15


@dataclass
class Progress:
    """Grows line by line.

    Attributes:
        scenario: its name.
        parameters: as in the parameter file, all of them.
        session: where, when and with what it was measured, for a person.
        car: dimensions with which the lines were laid out, None before the Car was mapped.
        results: one per measured line, in order of their numbers.
        retried: numbers of invalid lines that were measured again.
        frame_record: Car coordinate system of each line, and the self-checks.
    """

    scenario: str
    parameters: dict[str, Any]
    session: dict[str, Any] = field(default_factory=dict)
    car: CarDimensions | None = None
    results: list[Result] = field(default_factory=list)
    retried: list[int] = field(default_factory=list)
    frame_record: FrameRecord = field(default_factory=FrameRecord)

    def to_document(self) -> dict[str, Any]:
        """Plain values for a file."""
        return {"format": FORMAT, "version": VERSION, **dataclasses.asdict(self)}

    def record_check(self, check: CarCheck, frame: KnownFrame | None, time_s: float) -> None:
        """Add a self-check."""
        self.frame_record.note_check(check, frame, time_s)

    def record(self, scenario: Scenario, result: Result, frame: KnownFrame | None = None) -> None:
        """Add a line, measured in this frame; one measured before is replaced unless it was the better one."""
        number = scenario.number_of(result)
        former = next((old for old in self.results if scenario.number_of(old) == number), None)
        if former is not None:
            self.retried.append(number)
            if scenario.invalid_count(former) < scenario.invalid_count(result):
                return
            self.results.remove(former)
        self.frame_record.note_line(number, frame)
        self.results.append(result)
        self.results.sort(key=scenario.number_of)

    def measured(self, scenario: Scenario) -> list[int]:
        """Numbers of the lines that have a result."""
        return [scenario.number_of(result) for result in self.results]

    def to_retry(self, scenario: Scenario) -> list[int]:
        """Numbers of the invalid lines that are still to be measured again."""
        return [scenario.number_of(result) for result in self.results
                if scenario.invalid_count(result) and scenario.number_of(result) not in self.retried]

    def check_car(self, mapped: CarDimensions) -> None:
        """Raise ProgressFileError when the Car that was mapped now is not the one of the lines measured so far."""
        if self.car is None:
            return
        for name in ("length", "width"):
            then, now = getattr(self.car, name), getattr(mapped, name)
            if abs(now - then) > SAME_CAR_M:
                raise ProgressFileError(f"The progress file belongs to another Car: its {name} was {then:.2f} m, "
                                        f"now it measures {now:.2f} m.")


def progress_from_document(document: Any, scenario: Scenario, parameters: dict[str, Any]) -> Progress:
    """Progress of a test with this scenario and these parameters; ProgressFileError says what does not fit."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise ProgressFileError("It is not a progress file of this application.")
    if document.get("version") != VERSION:
        raise ProgressFileError(f"It has version {document.get('version')}; this application reads version {VERSION}.")
    if document.get("scenario") != scenario.name:
        raise ProgressFileError(f"It belongs to the scenario {document.get('scenario')}, not to {scenario.name}.")
    _check_parameters(document.get("parameters"), parameters, scenario)
    try:
        progress = Progress(scenario.name, parameters, dict(document["session"]), _car_from(document["car"]),
                            list(document["results"]), [int(number) for number in document["retried"]],
                            record_from(document.get("frame_record")))
        _check_lines(progress, scenario)
        for result in progress.results:
            _check_result(result, scenario)
    except (KeyError, TypeError, ValueError, AttributeError):
        raise ProgressFileError("It is damaged: parts of it are missing or of the wrong kind.") from None
    return progress


def _car_from(car: Any) -> CarDimensions | None:
    if car is None:
        return None
    sizes = {name: float(car[name]) for name in car if name != "outline"}
    return CarDimensions(**sizes, outline=tuple((float(x), float(y)) for x, y in car.get("outline", ())))


def _check_parameters(stored: Any, wanted: dict[str, Any], scenario: Scenario) -> None:
    if not isinstance(stored, dict):
        raise ProgressFileError("It is damaged: the parameters are missing.")
    # Whether the Car is checked before a test changes no distance.
    for name in sorted((set(stored) | set(wanted)) - set(scenario.parameters_type.flags())):
        if stored.get(name) != wanted.get(name):
            raise ProgressFileError(f"It was measured with other parameters: {name} was {stored.get(name)}, "
                                    f"now it is {wanted.get(name)}.")


def _check_lines(progress: Progress, scenario: Scenario) -> None:
    if progress.results and progress.car is None:
        raise ValueError("results without a Car")
    numbers = progress.measured(scenario)
    if numbers != sorted(set(numbers)) or not all(isinstance(number, int) for number in numbers):
        raise ValueError("numbers of the lines")


def _check_result(result: Result, scenario: Scenario) -> None:
    for column in scenario.columns:
        value = result[column.name]
        if column.unit and not (value is None or _is_number(value)):
            raise TypeError(column.name)
    if not isinstance(result[REASON], str):
        raise TypeError(REASON)
    for measurement in scenario.measurements:
        is_measured = LineStatus(result[measurement.status]) is LineStatus.OK
        if is_measured and not _is_number(result[measurement.distance]):
            raise TypeError(measurement.distance)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
