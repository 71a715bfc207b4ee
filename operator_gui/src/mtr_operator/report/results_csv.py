"""Writes results.csv: one row per measured line, metadata in rows that begin with '#' above the header.

Texts from people may contain quotes, commas and text that a spreadsheet interprets as a formula. An apostrophe, the
spreadsheets' text mark, keeps such a cell of a line plain text; all other lines are unchanged.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
import io
import re
from typing import Any, Iterator, Sequence

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.results.document import plain
from mtr_operator.domain.results.line_result import Column
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.storage.recorded.spreadsheet import guarded

from .columns.assessed_columns import AssessedColumns
from .columns.shown_columns import ShownColumns
from .figures import meanings
from .identity.identity_rows import identity_lines
from .table import line_text

FILE_NAME = "results.csv"
_TEXT = "'"
# After a separator: a quote, which joins all text up to the next quote to one cell, or the beginning of a formula.
_NO_TEXT = re.compile(r"""(?<=[,;])(?=\s*[=@"]|[-+\t])""")


def results_csv(scenario: AnyScenario, progress: Progress, assessment: Assessment | None = None) -> str:
    """Return the content of the file; without an assessment its columns are empty."""
    file = io.StringIO()
    added = AssessedColumns(scenario, assessment)
    shown = ShownColumns(scenario, scenario.parameters_type.from_mapping(progress.parameters))
    columns = shown.inserted(scenario.result_type.columns(), shown.columns)
    for line in (*_metadata(scenario, progress, columns), *added.metadata()):
        file.write(f"# {_NO_TEXT.sub(_TEXT, ' '.join(line.splitlines()))}\n")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(column.name for column in (*columns, *added.columns))
    for result in progress.results:
        own = [plain(getattr(result, column.name)) for column in scenario.result_type.columns()]
        row = shown.inserted(own, shown.values(result))
        writer.writerow((*map(_cell, columns, row), *map(_cell, added.columns, added.values(result))))
    return file.getvalue()


def _metadata(scenario: AnyScenario, progress: Progress, columns: Sequence[Column]) -> Iterator[str]:
    yield f"scenario: {scenario.title}"
    for name, entry in progress.session.items():
        yield f"{name}: {_one_line(entry)}"
    yield from identity_lines(progress.identity)
    car = progress.car
    if car is not None:
        yield f"Car length: {car.length:.3f} m (sigma {car.length_sigma:.3f} m)"
        yield f"Car width: {car.width:.3f} m (sigma {car.width_sigma:.3f} m)"
    for declared in scenario.parameters_type.declarations().values():
        value = progress.parameters[declared.file_key]
        shown = "not set" if value is None else declared.text(value)
        yield f"parameter {declared.file_key}: {shown}"
    for name, choice in scenario.parameters_type.choices().items():
        yield f"parameter {name}: {progress.parameters.get(name, choice.default)}"
    for name in scenario.parameters_type.flags():
        yield f"parameter {name}: {str(progress.parameters.get(name, False)).lower()}"
    yield from progress.frame_record.sentences()
    for column in columns:
        unit = f" [{column.unit}]" if column.unit else ""
        yield f"column {column.name}{unit}: {column.doc}"
    yield from _results(scenario, progress)


def _results(scenario: AnyScenario, progress: Progress) -> Iterator[str]:
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    for result in progress.results:
        yield f"result: {_one_line(line_text(scenario, result, parameters))}"
    yield from meanings(progress.results)
    for name, text in part(scenario, Concluding).summary(progress.results):
        yield f"summary {name}: {text}"
    for result in progress.results:
        if result.reason:
            yield f"{scenario.line_word} {result.number} is invalid: {_one_line(result.reason)}"


def _cell(column: Column, value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        # Adding zero converts -0.0 to 0.0.
        return f"{round(value, column.digits) + 0.0:.{column.digits}f}"
    if isinstance(value, list):
        return " ".join(_cell(column, each) for each in value)
    return guarded(str(value))


def _one_line(value: Any) -> str:
    return " ".join(str(value).split())
