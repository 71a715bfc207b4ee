"""The course of a test on disk: one JSON list a line, only ever appended to; see domain/results/course.

    ["mtr-operator course", 1, [names of a Status' values], [names of a mark's]]
    ["s", [values of a Status], [values of the mark of the bus] or null]
    ["n", kind, {values}]

A line that is cut off ends what can be read.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import dataclasses
import json
import math
import os
import pathlib
from typing import Any, Iterator, Mapping, NamedTuple, TextIO, Union

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.ports import BusMark
from mtr_operator.domain.results.course import Course
from mtr_operator.domain.robot_status import CarFrame, Interventions, RobotStatus

FORMAT, VERSION = "mtr-operator course", 1
_STATUS, _NOTE = "s", "n"
_VALUES = ("id", "robot_session_id", "stamp_s", "sent_s", "steady_s", "x", "y", "heading", "speed_mps", "pose_valid",
           "position_sigma_m", "variance_x_m2", "variance_y_m2", "covariance_xy_m2", "heading_sigma_rad", "key_x",
           "key_y", "key_height_m")
_FRAME, _CLOCK_STEPS = "frame_revision", "clock_steps"
_NAMES = (*_VALUES, _FRAME, _CLOCK_STEPS)
_MARK = tuple(item.name for item in dataclasses.fields(BusMark))
# Statuses between two times at which what was written leaves this program.
_FLUSH_EVERY = 10
# Some hundred Statuses.
_TAIL_BYTES = 64 * 1024


class Moment(NamedTuple):
    """A Status, and how far the log of the bus had come; None without a log."""

    status: RobotStatus
    mark: BusMark | None


class Note(NamedTuple):
    """What was done after the Status before it."""

    kind: str
    values: Mapping[str, Any]


Entry = Union[Moment, Note]


class CourseFile(Course):
    """Begins the file with the first Status. A disk that is full ends it, and no test.

    Attributes: problem: why it ended; empty while it goes on.
    """

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.problem = ""
        self._file: TextIO | None = None
        self._statuses = 0

    def status(self, status: RobotStatus, mark: BusMark | None) -> None:
        """See Course."""
        values = [*(getattr(status, name) for name in _VALUES), status.car_frame.revision,
                  status.interventions.clock_steps]
        self._write([_STATUS, list(map(_plain, values)),
                     None if mark is None else [_plain(getattr(mark, name)) for name in _MARK]])
        self._statuses += 1
        if self._file is not None and self._statuses % _FLUSH_EVERY == 0:
            self._try(self._file.flush)

    def note(self, kind: str, values: Mapping[str, Any]) -> None:
        """See Course."""
        if self._file is not None:
            self._write([_NOTE, kind, dict(values)])

    def close(self) -> None:
        """Safe to call twice."""
        file, self._file = self._file, None
        if file is not None:
            self._try(file.close)

    def _write(self, entry: list[Any]) -> None:
        if not self.problem:
            self._try(lambda: self._append(entry))

    def _append(self, entry: list[Any]) -> None:
        if self._file is None:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._file = open(self.path, "x", encoding="utf-8")  # noqa: SIM115, closed by close()
            self._file.write(_line([FORMAT, VERSION, _NAMES, _MARK]))
        self._file.write(_line(entry))

    def _try(self, write: Any) -> None:
        try:
            write()
        except OSError as error:
            self.problem = f"The course of the test is not kept in {self.path} any more: {error.strerror or error}."


def read_course(path: pathlib.Path) -> Iterator[Entry]:
    """All that is whole; ProgressFileError when it is no course, or damaged before its last line."""
    try:
        with open(path, encoding="utf-8") as file:
            yield from _entries(path, file)
    except OSError as error:
        raise ProgressFileError(f"The course {path} cannot be read: {error.strerror or error}.") from None
    except UnicodeDecodeError:
        raise ProgressFileError(f"The course {path} is damaged; it is no text.") from None


def newest_moment(path: pathlib.Path) -> Moment | None:
    """The last Status that is whole, without reading what lies before; None when none is found near the end."""
    try:
        with open(path, "rb") as file:
            names = json.loads(file.readline())[2]
            begun, ended = file.tell(), file.seek(0, os.SEEK_END)
            file.seek(max(begun, ended - _TAIL_BYTES))
            # What lies behind the last end of a line is still being written.
            lines = file.read().split(b"\n")[:-1]
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return None
    for line in reversed(lines):
        # The first one may be cut, and notes lie between.
        with contextlib.suppress(ValueError, LookupError, TypeError, RecursionError):
            kind, values, *_ = json.loads(line)
            if kind == _STATUS:
                return Moment(_status(dict(zip(names, values))), None)
    return None


def _entries(path: pathlib.Path, file: TextIO) -> Iterator[Entry]:
    names: list[str] = []
    mark_names: list[str] = []
    for number, line in enumerate(file, 1):
        if not line.endswith("\n"):
            # What a killed application has left.
            return
        try:
            entry = json.loads(line)
            if number == 1:
                if entry[:2] != [FORMAT, VERSION]:
                    raise ValueError(entry[0])
                names, mark_names = list(entry[2]), list(entry[3])
            elif entry[0] == _STATUS:
                yield Moment(_status(dict(zip(names, entry[1]))), _mark(mark_names, entry[2]))
            elif entry[0] == _NOTE:
                yield Note(str(entry[1]), dict(entry[2]))
        except (ValueError, LookupError, TypeError, RecursionError):
            raise ProgressFileError(f"The course {path} is damaged in line {number}, or of another version.") from None


def _status(values: Mapping[str, Any]) -> RobotStatus:
    known = {name: _value(values[name]) for name in _VALUES}
    return RobotStatus(**known, car_frame=CarFrame(values[_FRAME]),
                       interventions=Interventions(clock_steps=values[_CLOCK_STEPS]))


def _mark(names: list[str], values: Any) -> BusMark | None:
    if values is None:
        return None
    return BusMark(**{name: value if name == "stamps" else _value(value) for name, value in zip(names, values)})


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _value(value: Any) -> Any:
    if value is not None and not isinstance(value, (int, float)):
        raise TypeError("no number")
    return math.nan if value is None else value


def _line(entry: Any) -> str:
    return json.dumps(entry, ensure_ascii=False, separators=(",", ":"), allow_nan=False) + "\n"
