"""State of a test that survives the application: what was wanted, and what has been measured so far."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any, Mapping

from .. import limits
from ..errors import ProgressFileError
from ..estimation.budget.calibration import CalibrationRecord
from ..identity.identity import Identity
from ..limits import first_violation
from ..robot_status import CarDimensions
from ..verdict.limits import Limits
from .frame_history import KnownFrame
from .frame_record import FrameRecord
from .journal import KeptPoint
from .line_result import LineResult

FORMAT = "mtr-operator progress"
VERSION = 1
# A Car that measures this much differently on a later day is another Car, however unsure both sizes are; one that
# differs by less than the second is the same, however sure they are.
SAME_CAR_M, _NO_OTHER_CAR_M = 0.15, 0.02
_SIGMAS = 3.0
# Of the Car's sides; records from before these were sent have none.
_SIDE_SIGMAS = ("front_sigma", "rear_sigma", "left_sigma", "right_sigma")


@dataclass(frozen=True)
class JournalMark:
    """Which journal, and how many of its entries are in the progress."""

    id: str
    entries: int


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
        kept: how far the journal reached, None without one.
        line_at_hand: number of the line that was begun last, None when it has come to its end.
        points: what was measured on it, by word; the journal alone holds them until the line is complete.
        limits: that the lines are judged by, None without.
        calibration: record of the robot with which it was measured, None in a file from before there was one.
        identity: whose car and key, who measured where with what; None in a file from before there was one, or when
            nobody said anything.
        skipped: numbers of the invalid lines that the Operator left; they are measured again only on request.
        notice: what a person has to know of how it was recovered; empty when nothing was lost.
        journal: the lines from which it was recovered to go on with, empty since then; a journal elsewhere begins with
            them.
    """

    scenario: str
    parameters: dict[str, Any]
    session: dict[str, str] = field(default_factory=dict)
    car: CarDimensions | None = None
    results: list[LineResult] = field(default_factory=list)
    retried: list[int] = field(default_factory=list)
    frame_record: FrameRecord = field(default_factory=FrameRecord)
    kept: JournalMark | None = None
    line_at_hand: int | None = None
    points: dict[str, KeptPoint] = field(default_factory=dict)
    limits: Limits | None = None
    calibration: CalibrationRecord | None = None
    identity: Identity | None = None
    skipped: list[int] = field(default_factory=list)
    notice: str = field(default="", compare=False)
    journal: bytes = field(default=b"", compare=False, repr=False)

    def to_document(self) -> dict[str, Any]:
        """Plain values for a file."""
        kept = {} if self.kept is None else {"journal": dataclasses.asdict(self.kept)}
        parts = (("limits", self.limits), ("calibration", self.calibration), ("identity", self.identity))
        given: dict[str, Any] = {name: part.to_document() for name, part in parts if part is not None}
        if self.skipped:
            given["skipped"] = self.skipped
        return {"format": FORMAT, "version": VERSION, "scenario": self.scenario, "parameters": self.parameters,
                "session": self.session, "car": None if self.car is None else car_document(self.car),
                "results": [result.to_document() for result in self.results], "retried": self.retried,
                "frame_record": dataclasses.asdict(self.frame_record), **given, **kept}

    @property
    def has_findings(self) -> bool:
        """True when something was measured."""
        return bool(self.results or self.points)

    @property
    def measured_car(self) -> CarDimensions:
        """The Car with which the lines were laid out; there is one as soon as a line is measured."""
        if self.car is None:
            raise ValueError("No Car has been mapped in this test.")
        return self.car

    def note_used(self, what: str, name: str) -> None:
        """What is used from now on stands in the record, behind what something was measured with before."""
        before = self.session.get(what, "") if self.has_findings else ""
        self.session[what] = ", ".join(dict.fromkeys(filter(None, (*before.split(", "), name))))

    def with_earlier(self, used: Mapping[str, str]) -> dict[str, str]:
        """Add what stands in the record of an earlier part of the test, such as another adapter, before each text."""
        if not self.has_findings:
            return dict(used)
        before = {what: self.session.get(what, "").split("; ") for what in used}
        return {what: "; ".join(dict.fromkeys(filter(None, (*before[what], text)))) for what, text in used.items()}

    def begin_line(self, number: int) -> None:
        """A line is begun from its start; what was measured on it before stays in the journal."""
        self.line_at_hand = number
        self.points.clear()
        self.skipped = [skipped for skipped in self.skipped if skipped != number]

    def skip(self, number: int) -> None:
        """The Operator leaves a line."""
        self.skipped.append(number)

    def measure_further(self) -> None:
        """A line that has a result gets more attempts; interrupted, it keeps that result."""
        self.line_at_hand = None
        self.points.clear()

    def record(self, result: LineResult, frame: KnownFrame | None = None) -> None:
        """Add a line, measured in this frame; one measured before is replaced unless it was the better one."""
        number = result.number
        self.line_at_hand = None
        self.points.clear()
        former = next((old for old in self.results if old.number == number), None)
        if former is not None:
            self.retried.append(number)
            if former.invalid_count < result.invalid_count:
                self._keep_skipped()
                return
            self.results.remove(former)
        self.frame_record.note_line(number, frame)
        self.results.append(result)
        self.results.sort(key=lambda measured: measured.number)
        self._keep_skipped()

    def _keep_skipped(self) -> None:
        """A line that is as it should be, of before or in spite of the skip, is none that was skipped."""
        invalid = {result.number for result in self.results if result.invalid_count}
        self.skipped = [number for number in self.skipped if number in invalid]

    def revise(self, result: LineResult) -> None:
        """The same line, measured once, as all lines together show it; ValueError when it has no result."""
        index = self.measured().index(result.number)
        self.results[index] = result

    def measured(self) -> list[int]:
        """Numbers of the lines that have a result."""
        return [result.number for result in self.results]

    def to_retry(self) -> list[int]:
        """Numbers of the invalid lines that are still to be measured again."""
        return [result.number for result in self.results
                if result.invalid_count and result.number not in self.retried and result.number not in self.skipped]

    def check_car(self, mapped: CarDimensions) -> None:
        """Raise ProgressFileError when the Car that was mapped now is not the one of the lines measured so far."""
        if self.car is None:
            return
        for name in ("length", "width"):
            then, now = getattr(self.car, name), getattr(mapped, name)
            sigma_m = math.hypot(getattr(self.car, f"{name}_sigma"), getattr(mapped, f"{name}_sigma"))
            # A sigma that is not known (NaN) leaves the first one.
            if abs(now - then) > max(_NO_OTHER_CAR_M, min(SAME_CAR_M, _SIGMAS * sigma_m)):
                raise ProgressFileError(f"The progress file belongs to another Car: its {name} was {then:.2f} m, "
                                        f"now it measures {now:.2f} m. Continue the test at the Car with which it was "
                                        "begun, or begin a new one.")


def car_document(car: CarDimensions) -> dict[str, Any]:
    """Plain values of the Car; what the robot does not say has none."""
    return {name: value for name, value in dataclasses.asdict(car).items()
            if name not in _SIDE_SIGMAS or not math.isnan(value)}


def car_from(document: Mapping[str, Any]) -> CarDimensions:
    """The Car in a file; LookupError, TypeError, ValueError or AttributeError when it is damaged."""
    outline = document.get("outline", ())
    known = {name: value for name, value in document.items()
             if name != "outline" and not (name in _SIDE_SIGMAS and value is None)}
    car = CarDimensions(**known, outline=tuple((x, y) for x, y in outline))
    checked = [(limits.CAR_LENGTH, car.length), (limits.CAR_WIDTH, car.width), (limits.CAR_SIGMA, car.length_sigma),
               (limits.CAR_SIGMA, car.width_sigma),
               *((limits.CAR_SIGMA, known[name]) for name in _SIDE_SIGMAS if name in known),
               *((limits.OUTLINE, value) for point in outline for value in point)]
    violation = first_violation(checked)
    if violation or len(outline) > limits.MAX_OUTLINE_POINTS:
        raise ValueError(violation)
    return car
