"""What the robot's LiDARs saw during a test, on disk: one JSON list a line, only ever appended to.

    ["mtr-operator scans", 1]
    [robot time in s, [x in m, y in m, heading in rad] of base_link in the Car coordinate system or null, [x, y, ...]]

The returns are whole centimetres in base_link, as the link carries them. Not all are kept: see EVERY_S and MAX_BYTES.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import math
import pathlib
from typing import Any, Iterator, Mapping, NamedTuple, TextIO

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.ports import BusMark
from mtr_operator.domain.results.course import Course
from mtr_operator.domain.robot_status import RobotStatus

FORMAT, VERSION = "mtr-operator scans", 1
# A robot sends five a second; for a picture of where everything stood one is enough: at most 5 KB.
EVERY_S = 1.0
# Four hours of the fullest scans. The rest of a longer run is not kept.
MAX_BYTES = 64 * 1024 * 1024
_CM_PER_M = 100.0


class Scan(NamedTuple):
    """pose: of base_link in the Car coordinate system (x, y in m, heading in rad), None where it was not known. points:
    returns in base_link, in m."""

    time_s: float
    pose: tuple[float, float, float] | None
    points: tuple[Point, ...]


class ScanFile(Course):
    """Hands all on to a course, and begins its own file with the first scan. A disk that is full ends it, and no test.

    Attributes: problem: why it ended; empty while it goes on.
    """

    def __init__(self, path: pathlib.Path, course: Course, max_bytes: int = MAX_BYTES):
        self.path = path
        self.problem = ""
        self._course = course
        self._max_bytes = max_bytes
        self._bytes = 0
        self._kept_s = -math.inf
        self._file: TextIO | None = None

    def status(self, status: RobotStatus, mark: BusMark | None) -> None:
        """See Course."""
        self._course.status(status, mark)
        # A clock that was set back begins anew.
        if status.surroundings is not None and status.surroundings.points and not self.problem \
                and not 0.0 <= status.stamp_s - self._kept_s < EVERY_S:
            self._keep(status, status.surroundings.points)

    def note(self, kind: str, values: Mapping[str, Any]) -> None:
        """See Course."""
        self._course.note(kind, values)

    def close(self) -> None:
        """Safe to call twice."""
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _keep(self, status: RobotStatus, points: tuple[Point, ...]) -> None:
        self._kept_s = status.stamp_s
        pose = [status.x, status.y, status.heading] if status.pose_valid else None
        line = _line([status.stamp_s, pose, [round(value * _CM_PER_M) for point in points for value in point]])
        if self._bytes + len(line) > self._max_bytes:
            self.problem = (f"The scans of the LiDARs fill {self._max_bytes // 1024} KiB in {self.path}; those after "
                            f"{status.stamp_s:.0f} s of robot time are not kept.")
            return
        try:
            self._append(line)
        except OSError as error:
            self.problem = f"The scans of the LiDARs are not kept in {self.path} any more: {error.strerror or error}."

    def _append(self, line: str) -> None:
        if self._file is None:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._file = open(self.path, "x", encoding="utf-8")  # noqa: SIM115, closed by close()
            self._file.write(_line([FORMAT, VERSION]))
        self._file.write(line)
        self._file.flush()
        self._bytes += len(line)


def read_scans(path: pathlib.Path) -> Iterator[Scan]:
    """All that are whole; ProgressFileError when the file holds no scans, or is damaged before its last line."""
    number = 0
    try:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if not line.endswith("\n"):
                    # What a killed application has left.
                    return
                entry = json.loads(line)
                if number > 1:
                    yield _scan(*entry)
                elif entry != [FORMAT, VERSION]:
                    raise ValueError(entry)
    except OSError as error:
        raise ProgressFileError(f"The scans {path} cannot be read: {error.strerror or error}.") from None
    except (ValueError, TypeError, RecursionError, OverflowError):
        raise ProgressFileError(f"The scans {path} are damaged in line {max(number, 1)}, or of another "
                                "version.") from None


def _scan(time_s: Any, pose: Any, numbers: Any) -> Scan:
    values = iter([float(number) / _CM_PER_M for number in numbers])
    x_m, y_m, heading_rad = (math.nan,) * 3 if pose is None else map(float, pose)
    return Scan(float(time_s), None if pose is None else (x_m, y_m, heading_rad), tuple(zip(values, values)))


def _line(entry: list[Any]) -> str:
    return json.dumps(entry, separators=(",", ":"), allow_nan=False) + "\n"
