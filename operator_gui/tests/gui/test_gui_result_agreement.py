"""Table, window, PDF and results.csv agree on each distance, in every scenario and for all that can be known."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
import dataclasses
import enum
from typing import get_args

import pytest

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.document import kinds_of
from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence.adapters.tables import results_table as rows_of
from mtr_operator.gui.pictures.protocol_picture import Protocol
from mtr_operator.gui.pictures.protocol_tables import _lines
from mtr_operator.gui.screens.results_model import ResultsModel
from mtr_operator.report.figures import INTERVAL
from mtr_operator.report.results_csv import results_csv
from mtr_operator.report.table import results_table

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
OK, NOT_REACHED, INVALID = LineStatus.OK, LineStatus.NOT_REACHED, LineStatus.INVALID
# What a method may tell, and the triple of the file.
KNOWN = {
    "boundary": ((OK, 12.8135, 0.75, 11.35, 14.28, 0.1), (12.8135, 11.35, 14.28), {"is_boundary": True}),
    "event": ((OK, 1.5243, 0.0021), (1.5243, None, None), {}),
    "at least": ((OK, None, None, 2.125), (None, 2.125, None), {"is_boundary": True}),
    "at most": ((OK, None, None, None, 4.35), (None, None, 4.35), {"is_boundary": True}),
    "unknown": ((OK, None, None), (None, None, None), {"is_boundary": True}),
    "between places": ((OK, 9.5, 0.01), (None, 9.5, 10.0), {"is_place": True, "failed_m": 10.0}),
    "last place": ((OK, 9.5, 0.01), (None, 9.5, None), {"is_place": True}),
    "not reached, at least": ((NOT_REACHED, None, None, 3.05), (None, 3.05, None), {}),
    "not reached, at most": ((NOT_REACHED, None, None, None, 0.5), (None, None, 0.5), {}),
    "invalid": ((INVALID, None, None), (None, None, None), {}),
}
EMPTY = {int: 1, float: 1.0, str: "", bool: False}


def blank(kind):
    """Any value of a kind of field."""
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return next(iter(kind))
    # What may be absent is.
    return EMPTY[kind] if kind in EMPTY else None if type(None) in get_args(kind) else ()


def line(scenario, made):
    """A result of the scenario whose distances are these."""
    fields = [each for each in dataclasses.fields(scenario.result_type) if each.default is dataclasses.MISSING]
    kinds = kinds_of(scenario.result_type)
    shown = type("Shown", (scenario.result_type,), {"distances": property(lambda _: made), "findings": ()})
    return shown(**{each.name: blank(kinds[each.name]) for each in fields})


def distance(word, known):
    values, _, words = KNOWN[known]
    return MeasuredDistance(word, *values, **words)


def bounded(unreached, known):
    """A scenario may know an end of what was not reached by its parameters alone."""
    low_m, high_m = unreached
    expected = KNOWN[known][1]
    if not known.startswith("not reached"):
        return expected
    return None, low_m if expected[1] is None else expected[1], high_m if expected[2] is None else expected[2]


def text_of(triple):
    """What a table shows for the cells of a distance without a value."""
    _, low_m, high_m = triple
    if low_m is None:
        return "" if high_m is None else f"at most {high_m:.2f}"
    return f"at least {low_m:.2f}" if high_m is None else f"{low_m:.2f} to {high_m:.2f}"


def tables(scenario, parameters, progress):
    """First distance of each line as command line, window and PDF show it."""
    protocol = Protocol(scenario, parameters, progress)
    model = ResultsModel(protocol)
    window = [model.data(model.index(row, 2)) for row in range(model.rowCount())]
    rows = [[text for text, *_ in row.cells] for row in _lines(protocol)]
    pdf = [row[2] for row in rows[1:1 + len(progress.results)]]
    console = list(results_table(scenario, progress.results, parameters))[1:1 + len(progress.results)]
    return window, pdf, console


def number(cell):
    return None if cell == "" else float(cell)


@pytest.mark.parametrize("known", KNOWN)
@pytest.mark.parametrize("name", SCENARIOS)
def test_table_window_pdf_and_file_agree_on_each_line(name, known):
    scenario = SCENARIOS[name]
    parameters = scenario.parameters_type()
    words = scenario.distance_words
    result = line(scenario, tuple(distance(word, known) for word in words))
    progress = Progress(name, parameters.to_mapping(), {}, CAR, [result])
    content = results_csv(scenario, progress)
    row, = csv.DictReader(each for each in content.splitlines() if not each.startswith("#"))
    prefixes = ("",) if "result_m" in row else tuple(f"{word}_" for word in words)
    assert len(prefixes) == len(words)
    shown = [tuple(number(row[f"{prefix}{end}_m"]) for end in ("result", "low", "high")) for prefix in prefixes]
    assert shown == [bounded(part(scenario, Judging).unreached(parameters, result, word), known) for word in words]
    # Nothing that a reader takes for the result is left of it.
    names = list(row)
    first = names.index(f"{prefixes[0]}result_m")
    assert not any(each in ("distance_m", "uncertainty_m", "d50_m") or each.endswith("status")
                   for each in names[:first])
    for prefix in prefixes:
        for end in ("result", "low", "high"):
            assert f"# column {prefix}{end}_m [m]: " in content

    window, pdf, console = tables(scenario, parameters, progress)
    assert window == pdf and window[0] in console[0]
    text = text_of(shown[0])
    # Digits beyond those of the table are the file's own.
    if shown[0][0] is not None:
        assert float(window[0]) == pytest.approx(shown[0][0], abs=0.005)
    elif text:
        assert window == [text]
    else:
        assert not any(letter.isdigit() for letter in window[0])


@pytest.mark.parametrize("name", SCENARIOS)
def test_bundle_has_the_same_columns_as_the_file(name):
    scenario = SCENARIOS[name]
    parameters = scenario.parameters_type()
    result = line(scenario, tuple(distance(word, "boundary") for word in scenario.distance_words))
    progress = Progress(name, parameters.to_mapping(), {}, CAR, [result])
    row, = csv.DictReader(each for each in results_csv(scenario, progress).splitlines() if not each.startswith("#"))
    table = rows_of(scenario, progress, None)
    assert list(table.columns) == list(row)
    values = dict(zip(table.columns, next(iter(table.rows))))
    ends = [name for name in row if name.endswith(("result_m", "low_m", "high_m")) and row[name]]
    assert ends and all(values[name] == pytest.approx(float(row[name]), abs=5e-5) for name in ends)


def test_interval_of_the_table_is_that_of_the_file():
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type()
    results = [line(scenario, (distance("press", "boundary"),))]
    heading, row = list(results_table(scenario, results, parameters))[:2]
    assert INTERVAL in heading and "11.35 to 14.28" in row
