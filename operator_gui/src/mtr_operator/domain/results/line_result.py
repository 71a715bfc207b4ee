"""The result of one measured line: a record whose fields are the columns of results.csv and the keys of files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import enum
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Sequence, Tuple, TypeVar

from .. import limits
from ..estimation.looks import Look, are_possible, confidence_percent
from .document import Floats, OptionalFloat, Texts, plain, read_record, with_shown_texts
from .quantity import MeasuredQuantity

# Where attempts work as often as they fail: what the distances of a line stand for.
BOUNDARY_PERCENT = 50

Result = TypeVar("Result", bound="LineResult")


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


Ends = Tuple[OptionalFloat, OptionalFloat]


@dataclass(frozen=True)
class MeasuredDistance:
    """One distance of a line, in m with 1 sigma; None where nothing was measured.

    word: what it is called beside the line, "unlock". low_m, high_m: ends of the 95 % interval of the boundary that the
    distance stands for; None where the method gives none, one of them alone where the boundary lies beyond the other.
    is_boundary: the method tells the boundary by its interval, so that an end that is None is open.
    common_sigma_m: 1 sigma of what the attempts of all lines leave open alike. is_place: the distance is that of the
    farthest place that worked, and the boundary lies between it and failed_m, the next farther one that failed: None
    when none did. Of a boundary that was not reached failed_m is the nearest place that failed. key_m: where on its
    line the key was when the distance is not its own, but told by somebody; None when it is. look_m: ends of the
    interval at the level of the line's last look, by which a limit is judged, None for an open one; None without looks.
    """

    word: str
    status: LineStatus
    distance_m: OptionalFloat
    uncertainty_m: OptionalFloat
    low_m: OptionalFloat = None
    high_m: OptionalFloat = None
    common_sigma_m: OptionalFloat = None
    is_place: bool = False
    failed_m: OptionalFloat = None
    is_boundary: bool = False
    key_m: OptionalFloat = None
    look_m: Ends | None = None

    @property
    def is_open(self) -> bool:
        """The boundary may lie beyond an end of the places; a value and a sigma of it would say too much."""
        return self.is_boundary and (self.low_m is None or self.high_m is None)


def boundary(word: str, status: LineStatus, distance_m: OptionalFloat, sigma_m: OptionalFloat,
             ends_m: Ends) -> MeasuredDistance:
    """A boundary with its interval. Where an end of that is open the ends are all that is said: an estimate is no
    measured value."""
    is_open = None in ends_m
    return MeasuredDistance(word, status, None if is_open else distance_m, None if is_open else sigma_m, *ends_m,
                            is_boundary=True)


def has_intervals(results: Sequence[LineResult]) -> bool:
    """True when a table of the results has intervals to show."""
    return any((distance.low_m, distance.high_m) != (None, None) for result in results
               for distance in result.distances)


def column(doc: str, unit: str = "", digits: int = 4, default: Any = dataclasses.MISSING) -> Any:
    """Field of a LineResult that is a column of results.csv. A default is for what older files lack."""
    return dataclasses.field(default=default, metadata={"column": (unit, doc, digits)})


def stored(default: Any = dataclasses.MISSING) -> Any:
    """Field of a LineResult that is in the progress file only. A default is for what older files lack."""
    return dataclasses.field(default=default)


class LineResult(ABC):
    """Base of the scenarios' results; a scenario derives a frozen dataclass.

    Attributes:
        reason: why the line is invalid; empty when it is not. It stands above the table of results.csv.
        evidence: frames of the Car's bus that made it invalid, one text each.
        FILE_ORDER: keys of a progress file where their order is not that of the fields.
    """

    FILE_ORDER: ClassVar[tuple[str, ...]] = ()
    reason: str
    evidence: Texts

    @property
    @abstractmethod
    def number(self) -> int:
        """Number of the line, from 1."""

    @property
    @abstractmethod
    def place(self) -> str:
        """Where the line lies, for a person: "front right", "45°"."""

    @property
    @abstractmethod
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """Distances of the line, in the order of the scenario's distance_words."""

    def distances_at(self, share_percent: int) -> tuple[MeasuredDistance, ...]:
        """Distances at which this share of the attempts works, those that a limit may be about; () when not known."""
        return self.distances if share_percent == BOUNDARY_PERCENT else ()

    @property
    def quantities(self) -> tuple[MeasuredQuantity, ...]:
        """What else a limit may be about, each of the scenario's also where the line does not tell it."""
        return ()

    @property
    def findings(self) -> tuple[str, ...]:
        """What the line tells beside its distances, as a person reads it: "asleep after 58.0 to 62.0 s"."""
        return ()

    def holes_nearer_than(self, distance_m: float) -> tuple[float, ...]:
        """Places nearer than a distance that failed again and again although farther ones worked."""
        return ()

    @property
    def looks(self) -> tuple[Look, ...]:
        """At which the line was judged; none before more attempts were made for a verdict."""
        return ()

    @property
    def is_possible(self) -> bool:
        """False for a result from a file that cannot be one, beside what has to hold for each scenario's."""
        return are_possible(self.looks)

    @property
    def invalid_count(self) -> int:
        """How many of the distances are invalid."""
        return sum(distance.status is LineStatus.INVALID for distance in self.distances)

    @classmethod
    def columns(cls) -> tuple[Column, ...]:
        """Columns of results.csv, in the order of the fields."""
        declared = [(item.name, item.metadata["column"]) for item in _fields(cls) if "column" in item.metadata]
        return tuple(Column(name, *rest) for name, rest in declared)

    def to_document(self) -> dict[str, Any]:
        """Plain values for a progress file; what older files lack only where it says something."""
        names = self.FILE_ORDER or tuple(item.name for item in _fields(type(self)))
        defaults = {item.name: item.default for item in _fields(type(self))}
        return {name: plain(getattr(self, name)) for name in names if getattr(self, name) != defaults[name]}


class Looked:
    """Result of a line that may get more attempts for its verdict; before LineResult among the bases.

    Attributes:
        look_shares, look_spent: of each look, see Look.
    """

    look_shares: Floats
    look_spent: Floats

    @property
    def looks(self) -> tuple[Look, ...]:
        """See LineResult."""
        if len(self.look_shares) != len(self.look_spent):
            # No looks at all are possible that way.
            return (Look(math.inf, math.inf),)
        return tuple(Look(share, spent) for share, spent in zip(self.look_shares, self.look_spent))

    @property
    def look_percent(self) -> float | None:
        """Confidence of the interval by which the last look judges; None without looks."""
        return confidence_percent(self.looks) if self.looks else None


def at_looks(result: Result, looks: Sequence[Look]) -> Result:
    """The same measurements with these looks; the ends of its intervals have to be found anew."""
    # The derived classes are dataclasses.
    changed: Result = dataclasses.replace(  # type: ignore[type-var]
        result, look_shares=tuple(look.share for look in looks), look_spent=tuple(look.spent for look in looks))
    return changed


class OnAxis:
    """What results of an axis have in common; before LineResult among the bases."""

    axis: int
    side: str

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.axis

    @property
    def place(self) -> str:
        """See LineResult."""
        return self.side.replace("_", " ")


def result_from_document(result_type: type[Result], document: Any) -> Result:
    """Result in a progress file; KeyError, TypeError or ValueError when it is damaged."""
    result = with_shown_texts(read_record(result_type, document))
    for name, unit in ((item.name, item.unit) for item in result.columns()):
        value = getattr(result, name)
        limit, each = limits.OF_UNIT.get(unit, limits.PLAIN), value if isinstance(value, tuple) else (value,)
        if not all(limit.allows(number) for number in each if isinstance(number, float)):
            raise ValueError(f"{name} is beyond all limits")
    for distance in result.distances:
        _check(distance)
    if not limits.LINE_NUMBER.allows(result.number) or bool(result.reason) != bool(result.invalid_count):
        raise ValueError("number or reason of a line")
    if not result.is_possible:
        raise ValueError("values that are none of the scenario's")
    return result


def _check(distance: MeasuredDistance) -> None:
    """Raise ValueError for a distance that cannot be one."""
    has_distance = distance.distance_m is not None
    if has_distance != (distance.status is LineStatus.OK and not distance.is_open):
        raise ValueError(f"distance of {distance.word}")
    if has_distance and not limits.DISTANCE.allows(distance.distance_m):
        raise ValueError(f"distance of {distance.word}")
    if distance.uncertainty_m is not None and not limits.DISTANCE_SIGMA.allows(distance.uncertainty_m):
        raise ValueError(f"uncertainty of {distance.word}")
    for both in ((distance.low_m, distance.high_m), distance.look_m or ()):
        ends = [end for end in both if end is not None]
        if not all(limits.DISTANCE.allows(end) for end in ends) or sorted(ends) != ends:
            raise ValueError(f"interval of {distance.word}")


def _fields(result_type: type[LineResult]) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(result_type)  # type: ignore[arg-type]  # the derived classes are dataclasses
