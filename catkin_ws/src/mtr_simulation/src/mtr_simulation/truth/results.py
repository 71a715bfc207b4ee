"""Reads results.csv of both scenarios and truth_events.csv into lines of plain types."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib
import re
from typing import Dict, Iterable, Iterator, List, NamedTuple, Tuple

from mtr_core.errors import RobotError

DEFAULT_KEY_HEIGHT_M = 1.0
_KEY_HEIGHT = re.compile(r"^# parameter key_height_m: ([0-9.]+) m$", re.MULTILINE)


class ResultsError(RobotError):
    """A file is missing, foreign or broken."""


class TrueEvent(NamedTuple):
    """One line of truth_events.csv; kind is unlocked, locked or press, the key is in the true Car frame."""

    kind: str
    time_s: float
    key_x_m: float
    key_y_m: float
    accepted: bool


class MeasuredEvent(NamedTuple):
    """One measurement of results.csv. Times and distances are NaN where the cell is empty.

    event is unlock, lock or press; side, direction and origin are those of the axis, empty and 0 for a radial, whose
    angle is clockwise_rad from the Car's front.
    """

    line: str
    event: str
    status: str
    time_s: float
    distance_m: float
    uncertainty_m: float
    side: str
    direction: Tuple[float, float]
    origin: Tuple[float, float] = (0.0, 0.0)
    clockwise_rad: float = 0.0


def column_names(path: pathlib.Path) -> List[str]:
    """The header of a file."""
    return list(_reader(path).fieldnames or ())


def read_events(path: pathlib.Path) -> List[TrueEvent]:
    """All lines of truth_events.csv."""
    rows = _rows(path, ("event", "robot_time_s", "key_x_m", "key_y_m", "accepted"))
    return [
        TrueEvent(
            row["event"],
            _number(row, "robot_time_s", path),
            _number(row, "key_x_m", path),
            _number(row, "key_y_m", path),
            row["accepted"] == "1",
        )
        for row in rows
    ]


def read_autolock(path: pathlib.Path) -> List[MeasuredEvent]:
    """Two events, unlock and lock, for each axis."""
    names = ("status", "distance_m", "uncertainty_m", "robot_time_s")
    columns = [f"{event}_{name}" for event in ("unlock", "lock") for name in names]
    events = []
    for row in _rows(path, ("axis", "side", "origin_x_m", "origin_y_m", "direction_x", "direction_y", *columns)):
        direction = (_number(row, "direction_x", path), _number(row, "direction_y", path))
        origin = (_number(row, "origin_x_m", path), _number(row, "origin_y_m", path))
        for event in ("unlock", "lock"):
            measured = _measured(row, path, row["axis"], event, f"{event}_")
            events.append(measured._replace(direction=direction, origin=origin))
    return events


def read_key_press(path: pathlib.Path) -> List[MeasuredEvent]:
    """One event, press, for each radial."""
    rows = _rows(path, ("radial", "status", "distance_m", "uncertainty_m", "robot_time_s", "angle_deg"))
    return [_measured(row, path, row["radial"], "press", "")._replace(
        clockwise_rad=math.radians(_number(row, "angle_deg", path))) for row in rows]


def key_height_m(path: pathlib.Path) -> float:
    """The height of the Remote key that the metadata tell, else the scenarios' default."""
    found = _KEY_HEIGHT.search(_text(path))
    return float(found.group(1)) if found else DEFAULT_KEY_HEIGHT_M


def rows_of(path: pathlib.Path) -> Iterator[Dict[str, str]]:
    """All lines below the metadata."""
    return _rows(path, ())


def optional_number(row: Dict[str, str], column: str, path: pathlib.Path) -> float:
    """NaN for an empty cell, and for a column that the file does not have."""
    return _number(row, column, path) if column in row else math.nan


def _measured(row: Dict[str, str], path: pathlib.Path, line: str, event: str, prefix: str) -> MeasuredEvent:
    time_s, distance_m, uncertainty_m = (_number(row, f"{prefix}{name}", path)
                                         for name in ("robot_time_s", "distance_m", "uncertainty_m"))
    return MeasuredEvent(line, event, row[f"{prefix}status"], time_s, distance_m, uncertainty_m, row.get("side", ""),
                         (0.0, 0.0))


def _rows(path: pathlib.Path, columns: Iterable[str]) -> Iterator[Dict[str, str]]:
    """Lines below the metadata; every wanted column must exist, and every line must be whole."""
    reader = _reader(path)
    missing = [name for name in columns if name not in (reader.fieldnames or ())]
    if missing:
        raise ResultsError(f"{path} has no column {missing[0]}.")
    for number, row in enumerate(reader, start=1):
        if None in row.values() or None in row:
            raise ResultsError(f"{path} is broken: data line {number} has not as many cells as the header.")
        yield row


def _reader(path: pathlib.Path) -> "csv.DictReader[str]":
    return csv.DictReader(line for line in _text(path).splitlines() if line and not line.startswith("#"))


def _text(path: pathlib.Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}.") from error


def _number(row: Dict[str, str], column: str, path: pathlib.Path) -> float:
    if not row[column].strip():
        return math.nan
    try:
        return float(row[column])
    except ValueError as error:
        raise ResultsError(f"{path} is broken: {column} is {row[column]!r}, which is no number.") from error
