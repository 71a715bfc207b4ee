"""Sections of the page of a test in progress."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from dataclasses import dataclass
from typing import Any, Mapping

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.line_pairs import Side, open_side
from mtr_operator.history.reading import entry_of
from mtr_operator.storage.journal.journal_file import journal_of
from mtr_operator.storage.recorded.course_file import newest_moment
from mtr_operator.storage.recovery import progress_path

from ..intake.measurements import assessment_of, line_rows, measurement_rows
from ..intake.trials import Row, trials_of
from ..report.pages import distance_texts, render_part, trial_texts
from ..report.pictures import around_car_so_far
from .followed import SILENT_S, Seen
from .pace import CourseOfTest, course_of

# Parts of the page that change while it is shown, by the id of their element.
NOW, PICTURE, DISTANCES, POINTS = "now", "picture", "distances", "points"
_SECONDS_A_MINUTE = 60.0


@dataclass(frozen=True)
class MeasuredSoFar:
    """Contents of the progress file and journal of a test.

    Attributes:
        distances, points: formatted rows, the newest point first.
    """

    side: Side
    entry: TestEntry
    course: CourseOfTest
    distances: list[dict[str, str]]
    points: list[dict[str, Any]]


def read_so_far(path: pathlib.Path) -> MeasuredSoFar:
    """Read a test in progress; OperatorError if the files do not contain a test."""
    side = open_side(path)
    entries = journal_of(progress_path(path)).entries
    trials = trials_of(entries, side.progress.results)
    lines = list(line_rows(side, {row["line"] for row in trials}))
    measurements = measurement_rows(side, assessment_of(side), entries)
    return MeasuredSoFar(side, entry_of(path, side), course_of(entries), distance_texts(side, lines, measurements),
                         trial_texts(_newest_first(trials)))


def sections(measured: MeasuredSoFar, seen: Seen, number: int | None) -> Mapping[str, str]:
    """Return the HTML of each section by its id. number: of the test in the store, None if it is not stored."""
    status = None if seen.course is None or not seen.is_held else _status(seen.course)
    pose = Pose(status.x, status.y, status.heading) if status is not None and status.pose_valid else None
    return {NOW: render_part("live_now.html", **_now(measured, seen, status), number=number),
            PICTURE: around_car_so_far(measured.side, measured.points, pose),
            DISTANCES: render_part("live_distances.html", distances=measured.distances,
                                   line_word=measured.side.scenario.line_word),
            POINTS: render_part("live_points.html", points=measured.points)}


def _status(course: pathlib.Path) -> RobotStatus | None:
    moment = newest_moment(course)
    return None if moment is None else moment.status


def _now(measured: MeasuredSoFar, seen: Seen, status: RobotStatus | None) -> dict[str, Any]:
    entry, course = measured.entry, measured.course
    now_s = course.heard_s if status is None else status.stamp_s
    left_s = course.left_s(entry.total - entry.done, now_s) if seen.is_measured else None
    return {"state": _state(entry, seen), "is_measured": seen.is_measured, "entry": entry, "course": course,
            "left": "" if left_s is None else _time(left_s), "status": status,
            "heading_deg": math.degrees(status.heading) if status is not None else 0.0}


def _state(entry: TestEntry, seen: Seen) -> str:
    if seen.is_measured:
        return "is being measured"
    if seen.is_held:
        return (f"nothing was written for {_time(seen.silent_s)}: the application stands, was ended by force, or "
                f"waits; it writes at least every {SILENT_S:.0f} s while it measures")
    return "is complete" if entry.is_complete else "has ended before its last line"


def _time(seconds: float) -> str:
    if seconds < 2.0 * _SECONDS_A_MINUTE:
        return f"{seconds:.0f} s"
    return f"{seconds / _SECONDS_A_MINUTE:.0f} min"


def _newest_first(trials: list[Row]) -> list[Row]:
    """Sort by robot time, newest first; points without a time come last, line by line."""
    return sorted(trials, key=lambda row: -math.inf if row["robot_time_s"] is None else row["robot_time_s"],
                  reverse=True)
