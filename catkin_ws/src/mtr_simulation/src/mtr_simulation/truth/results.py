"""Reads results.csv of all scenarios and truth_events.csv into plain types."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib
import re
from typing import Dict, Iterable, Iterator, List, NamedTuple, Tuple

from mtr_core.errors import RobotError

DEFAULT_KEY_HEIGHT_M = 1.0


# Column of each scenario that numbers its lines; it identifies the scenario of a results.csv.
FIRST_COLUMN = {"autolock": "axis", "key_press": "radial", "zone_map": "zone", "handle_request": "axis"}
# Columns of an axis.
_AXIS = ("axis", "side", "origin_x_m", "origin_y_m", "direction_x", "direction_y")


class ResultsError(RobotError):
    """A file is missing, of another kind, or corrupt."""


class TrueEvent(NamedTuple):
    """One line of truth_events.csv; kind is unlocked, locked, press or handle, the key is in the true Car frame."""

    kind: str
    time_s: float
    key_x_m: float
    key_y_m: float
    accepted: bool


class MeasuredEvent(NamedTuple):
    """One measurement of results.csv. Times and distances are NaN if the cell is empty.

    event is unlock, lock, press, handle or reach. side, direction and origin belong to the axis; for a radial they are
    empty and 0, and its angle is clockwise_rad from the Car's front. A zone (reach) has only a side, and no event at a
    time. key_height_m is the height of the line; NaN if all lines have the height of the metadata. border_m is the
    nominal border of handle requests.
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
    key_height_m: float = math.nan
    border_m: float = math.nan


def column_names(path: pathlib.Path) -> List[str]:
    """Return the header of a file."""
    return list(_reader(path).fieldnames or ())


def read_events(path: pathlib.Path) -> List[TrueEvent]:
    """Return all lines of truth_events.csv."""
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
    """Return two events, unlock and lock, for each axis."""
    names = ("status", "distance_m", "uncertainty_m", "robot_time_s")
    columns = [f"{event}_{name}" for event in ("unlock", "lock") for name in names]
    return [_on_axis(_measured(row, path, row["axis"], event, f"{event}_"), row, path)
            for row in _rows(path, (*_AXIS, *columns)) for event in ("unlock", "lock")]


def read_key_press(path: pathlib.Path) -> List[MeasuredEvent]:
    """Return one event, press, for each radial."""
    rows = _rows(path, ("radial", "status", "distance_m", "uncertainty_m", "robot_time_s", "angle_deg"))
    return [_measured(row, path, row["radial"], "press", "")._replace(
        clockwise_rad=math.radians(_number(row, "angle_deg", path))) for row in rows]


def read_handle_request(path: pathlib.Path) -> List[MeasuredEvent]:
    """Return one event, handle, for each axis: the request at the largest distance that unlocked the Car."""
    names = ("status", "distance_m", "uncertainty_m", "robot_time_s", "key_height_m", "border_m")
    return [_on_axis(_measured(row, path, row["axis"], "handle", ""), row, path)._replace(
        key_height_m=_number(row, "key_height_m", path), border_m=_number(row, "border_m", path))
        for row in _rows(path, (*_AXIS, *names))]


def read_zone_map(path: pathlib.Path) -> List[MeasuredEvent]:
    """Return the end of each zone, reach; it results from many presses, and none of them is its event."""
    return [MeasuredEvent(row["zone"], "reach", row["status"], math.nan, _number(row, "distance_m", path),
                          _number(row, "uncertainty_m", path), row["side"], (0.0, 0.0),
                          key_height_m=_number(row, "height_m", path))
            for row in _rows(path, ("zone", "side", "height_m", "status", "distance_m", "uncertainty_m"))]


def key_height_m(path: pathlib.Path) -> float:
    """Return the height of the Remote key in the metadata, else the scenarios' default."""
    return parameter(path, "key_height_m", DEFAULT_KEY_HEIGHT_M)


def parameter(path: pathlib.Path, name: str, default: float) -> float:
    """Return a numeric parameter of the test from the metadata."""
    found = re.search(rf"^# parameter {name}: ([0-9.]+)(?: \S+)?$", _text(path), re.MULTILINE)
    return float(found.group(1)) if found else default


def rows_of(path: pathlib.Path) -> Iterator[Dict[str, str]]:
    """Return all lines below the metadata."""
    return _rows(path, ())


def optional_number(row: Dict[str, str], column: str, path: pathlib.Path) -> float:
    """Return NaN for an empty cell, and for a column that the file does not have."""
    return _number(row, column, path) if column in row else math.nan


def _measured(row: Dict[str, str], path: pathlib.Path, line: str, event: str, prefix: str) -> MeasuredEvent:
    time_s, distance_m, uncertainty_m = (_number(row, f"{prefix}{name}", path)
                                         for name in ("robot_time_s", "distance_m", "uncertainty_m"))
    return MeasuredEvent(line, event, row[f"{prefix}status"], time_s, distance_m, uncertainty_m, row.get("side", ""),
                         (0.0, 0.0))


def _on_axis(event: MeasuredEvent, row: Dict[str, str], path: pathlib.Path) -> MeasuredEvent:
    """Add the position of the axis."""
    return event._replace(direction=(_number(row, "direction_x", path), _number(row, "direction_y", path)),
                          origin=(_number(row, "origin_x_m", path), _number(row, "origin_y_m", path)))


def _rows(path: pathlib.Path, columns: Iterable[str]) -> Iterator[Dict[str, str]]:
    """Yield the lines below the metadata; every wanted column must exist, and every line must be complete."""
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
