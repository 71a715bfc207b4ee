"""Results and course of a test as tables for analyses: a row per line, and a row per Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
import pathlib
from typing import Any, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union, get_args, get_origin

from mtr_operator.domain.results.document import Floats, Texts, kinds_of, plain
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.columns.assessed_columns import AssessedColumns
from mtr_operator.report.columns.shown_columns import ShownColumns
from mtr_operator.storage.recorded.course_file import Moment, read_course

# Column types in SQL.
NUMBER, WHOLE, TRUTH, TEXT = "DOUBLE", "BIGINT", "BOOLEAN", "VARCHAR"
_KINDS = {float: NUMBER, int: WHOLE, bool: TRUTH, str: TEXT, Floats: f"{NUMBER}[]", Texts: f"{TEXT}[]"}
_POSE_COLUMNS = {"run": WHOLE, "robot_time_s": NUMBER, "pose_valid": TRUTH, "x_m": NUMBER, "y_m": NUMBER,
                 "heading_rad": NUMBER, "position_sigma_m": NUMBER, "heading_sigma_rad": NUMBER, "speed_mps": NUMBER,
                 "key_x_m": NUMBER, "key_y_m": NUMBER, "key_height_m": NUMBER, "frame_revision": WHOLE}


class Table(NamedTuple):
    """Table. columns: type of each by its name, in their order. rows: values in that order; None for an empty cell."""

    columns: Mapping[str, str]
    rows: Iterable[Sequence[Any]]


def results_table(scenario: AnyScenario, progress: Progress, assessment: Assessment | None) -> Table:
    """Return the columns of results.csv, with the same names and units, not rounded."""
    added = AssessedColumns(scenario, assessment)
    shown = ShownColumns(scenario, scenario.parameters_type.from_mapping(progress.parameters))
    kinds = kinds_of(scenario.result_type)  # type: ignore[arg-type]  # a class is hashable, which mypy does not see here
    names = [column.name for column in scenario.result_type.columns()]
    first = shown.inserted([(name, _kind(kinds[name])) for name in names],
                           [(column.name, NUMBER) for column in shown.columns])
    columns = {**dict(first), **{column.name: NUMBER if column.unit else TEXT for column in added.columns}}
    return Table(columns, ([*shown.inserted([plain(getattr(result, name)) for name in names], shown.values(result)),
                            *added.values(result)] for result in progress.results))


def poses_table(courses: Sequence[pathlib.Path]) -> Table:
    """Return the positions of robot and key at each Status of each run: Car coordinate system, robot's clock; None if
    unknown. While its rows are read, ProgressFileError for a damaged course."""
    return Table(_POSE_COLUMNS, (row for number, course in enumerate(courses, 1) for row in _poses(number, course)))


def _poses(number: int, course: pathlib.Path) -> Iterator[Sequence[Any]]:
    for entry in read_course(course):
        if isinstance(entry, Moment):
            yield [number, *(_finite(value) for value in _pose(entry.status))]


def _pose(status: RobotStatus) -> Iterator[Any]:
    places = (status.x, status.y, status.heading, status.position_sigma_m, status.heading_sigma_rad)
    yield from (status.stamp_s, status.pose_valid)
    yield from places if status.pose_valid else (None,) * len(places)
    yield status.speed_mps
    yield from status.key_place if status.pose_valid else (None, None)
    yield from (status.key_height_m, status.car_frame.revision)


def _kind(kind: Any) -> str:
    """Return the type of a field; an optional field has the type of the others, because each value may be missing."""
    kind = get_args(kind)[0] if get_origin(kind) is Union else kind
    return TEXT if isinstance(kind, type) and issubclass(kind, enum.Enum) else _KINDS[kind]


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
