"""A campaign of two tests in the window, and what their comparison says: checked against the tests' own files."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib
import re
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from PyQt5.QtWidgets import QApplication

from mtr_operator.gui.history.comparison_window import ComparisonWindow

# Cells are rounded to a centimetre each.
ROUNDED_M = 0.0051
LINES = 3
_NUMBER = re.compile(r"[+\u2212]\d+\.\d\d")
# Name of a single line: its number and its place.
_LINE = re.compile(r"\d+ \(")
NOT_KNOWN = "not known"


class Measured(NamedTuple):
    """A border as results.csv has it, with the ends of its 95 % interval, m. value_m: None where an end is not known,
    which is infinite: then the window says which the other one is."""

    value_m: Optional[float]
    low_m: float
    high_m: float


class Row(NamedTuple):
    """Cells of the comparison's table. number: of the line. value_m, low_m, high_m: second less first, None and
    infinite where nothing stands. first, second: as they stand there."""

    number: int
    word: str
    value_m: Optional[float]
    low_m: float
    high_m: float
    first: str
    second: str


def campaign(laptop: Any) -> None:
    """B7: the test of before is found, repeated with its parameters, and both are compared."""
    person = laptop.person
    person.click("Tests so far")
    person.wait_for("1 tests, 1 of them shown.")
    laptop.must_fit()
    person.choose_rows(person.application.window.history.table, 0)
    person.click("Repeat")
    person.wait_for(f"{LINES} lines")
    person.hold("Hold to start")
    person.follow("Key press protocol")
    person.wait_for("Saved protocol.png, results.csv to")
    person.click("New test")
    person.click("Tests so far")
    person.wait_for("2 tests, 2 of them shown.")
    person.choose_rows(person.application.window.history.table, 0, 1)
    person.click("Compare two")
    laptop.must("the comparison", lambda: _comparison() is not None)
    laptop.must_fit()
    rows, summary, is_starred = person.ask(_shown)
    # Folders are named by the instant at which their test began.
    first, second = sorted(person.application.flow.store.settings.result_folder.iterdir())
    check_rows(rows, _borders(first), _borders(second))
    check_summary(summary, rows)
    assert is_starred is ("No difference is shown among all rows." not in summary), summary
    person.click("Close")
    person.click("Back")


def check_rows(rows: List[Row], first: Dict[int, Measured], second: Dict[int, Measured]) -> None:
    """Each line once, with its difference and an interval that has at least the errors of both tests' own."""
    assert [row.number for row in rows] == sorted(first) == sorted(second), (rows, first, second)
    for row in rows:
        a, b = first[row.number], second[row.number]
        _check_cell(row.first, a)
        _check_cell(row.second, b)
        if a.value_m is None or b.value_m is None:
            assert row.value_m is None, (row, a, b)
        else:
            assert row.value_m is not None and abs(row.value_m - (b.value_m - a.value_m)) < ROUNDED_M, (row, a, b)
        low_m, high_m = difference_ends(a, b)
        assert row.low_m <= low_m + 2.0 * ROUNDED_M and row.high_m >= high_m - 2.0 * ROUNDED_M, (row, a, b)
        if math.isfinite(low_m) and math.isfinite(high_m) and row.value_m is not None:
            assert math.isfinite(row.low_m) and math.isfinite(row.high_m), (row, a, b)
        is_open = all(map(is_open_border, (a, b)))
        assert row.word.rstrip(" *") == word_of(row.low_m, row.high_m, is_open), row


def difference_ends(first: Measured, second: Measured) -> Tuple[float, float]:
    """95 % interval of second less first by their own intervals (MOVER); of open ones the ends as they are."""
    if first.value_m is None or second.value_m is None or not all(map(math.isfinite, (*first[1:], *second[1:]))):
        return second.low_m - first.high_m, second.high_m - first.low_m
    value_m = second.value_m - first.value_m
    return (value_m - math.hypot(second.value_m - second.low_m, first.high_m - first.value_m),
            value_m + math.hypot(second.high_m - second.value_m, first.value_m - first.low_m))


def is_open_border(border: Measured) -> bool:
    """Return True if an end of the interval is unknown."""
    return not (math.isfinite(border.low_m) and math.isfinite(border.high_m))


def word_of(low_m: float, high_m: float, is_open: bool) -> str:
    """Return the result for a difference with this interval. is_open: both distances have an unknown end."""
    if low_m > 0.0 or high_m < 0.0:
        return "farther" if low_m > 0.0 else "nearer"
    return NOT_KNOWN if is_open or math.isinf(low_m) and math.isinf(high_m) else "no difference shown"


def check_summary(summary: str, rows: List[Row]) -> None:
    """The counts are those of the rows; the same Car and parameters: only the days differ."""
    words = [row.word.rstrip(" *") for row in rows]
    for word in set(words):
        assert f"{words.count(word)} {word}" in summary, (summary, words)
    assert "Lines of one test only" not in summary and "radials" not in summary, summary


def _check_cell(cell: str, border: Measured) -> None:
    known_m = border.value_m
    if " to " in cell:
        # Two places between which a border lies that was not reached: no interval of the file contradicts them.
        low_m, high_m = map(float, cell.split(" to "))
        assert known_m is None and low_m <= border.high_m and high_m >= border.low_m, (cell, border)
        return
    for words, end_m in (("at least ", border.low_m), ("at most ", border.high_m)):
        if cell.startswith(words):
            assert border.value_m is None, (cell, border)
            cell, known_m = cell[len(words):], end_m
    if known_m is None:
        assert cell in {"not reached", "invalid", "unknown"}, (cell, border)
    else:
        assert abs(float(cell) - known_m) < ROUNDED_M, (cell, border)


def _comparison() -> Optional[ComparisonWindow]:
    return next((window for window in QApplication.topLevelWidgets()
                 if isinstance(window, ComparisonWindow) and window.isVisible()), None)


def _shown() -> Tuple[List[Row], str, bool]:
    """Return the rows of single lines, the summary, and whether any row has a star."""
    window = _comparison()
    assert window is not None
    model = window.table.model()
    cells = [[str(model.data(model.index(row, column))) for column in range(model.columnCount())]
             for row in range(model.rowCount())]
    is_starred = any(texts[2].endswith(" *") for texts in cells)
    return [_row(texts) for texts in cells if _LINE.match(texts[0])], window.summary.text(), is_starred


def _row(cells: List[str]) -> Row:
    line, _, word, difference, interval, _, first, second = cells
    return Row(int(line.split()[0]), word, _signed(difference) if difference else None, *_ends(interval), first, second)


def _ends(interval: str) -> Tuple[float, float]:
    found = [_signed(text) for text in _NUMBER.findall(interval)]
    if len(found) == 2:
        return found[0], found[1]
    low = found[0] if interval.startswith("at least") else -math.inf
    return low, found[0] if interval.startswith("at most") else math.inf


def _signed(text: str) -> float:
    return float(text.replace("\u2212", "-"))


def _borders(folder: pathlib.Path) -> Dict[int, Measured]:
    with (folder / "results.csv").open(encoding="utf-8", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {int(row["radial"]): _measured(row) for row in rows}


def _measured(row: Dict[str, str]) -> Measured:
    is_known = all(row[name] for name in ("d50_m", "d50_low_m", "d50_high_m"))
    return Measured(float(row["d50_m"]) if is_known else None, float(row["d50_low_m"] or -math.inf),
                    float(row["d50_high_m"] or math.inf))
