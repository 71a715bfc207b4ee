"""Differences of two tests as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt

from mtr_operator.history.statistics.comparison import Comparison
from mtr_operator.history.statistics.difference import Change
from mtr_operator.history.statistics.row import DISTANCE, NEIGHBOURS, UNITS, Row
from mtr_operator.history.statistics.texts import chance_text

from ..figure_text import cell_text, difference_text, estimate_text
from ..i18n import number, translate
from ..names import domain_word
from ..sentences import translated
from .table_model import TableModel

# Columns of words; after them come figures.
_WORDS = 3


class ComparisonModel(TableModel):
    """Quantity, distance with its unit, and result; second test less first, its 95 % interval, p-value among all, and
    the values of both tests; the reason of an unknown difference as a tip."""

    def __init__(self, comparison: Comparison, parent: QObject | None = None):
        super().__init__(parent)
        self._comparison = comparison

    def _rows(self) -> Sequence[Row]:
        return self._comparison.rows

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        row = self._comparison.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._texts(row)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return translated(row.difference.reason) or None
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() >= _WORDS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _headings(self) -> tuple[str, ...]:
        return (domain_word(self._comparison.tests.first.scenario.line_word).capitalize(), "", self.tr("Second test"),
                self.tr("Difference"), "95 %", self.tr("Chance among all"), self.tr("First"), self.tr("Second"))

    def _texts(self, row: Row) -> tuple[str, ...]:
        found = row.difference
        value, interval = difference_text(found.value, found.low, found.high)
        chance = "" if found.reason else chance_text(row.adjusted, number)
        unit = f" [{UNITS[row.quantity]}]" if UNITS[row.quantity] else ""
        return (row_name(self._comparison, row), words_text(row) + unit, result_text(row), value, interval,
                chance, *self._values(row))

    def _values(self, row: Row) -> tuple[str, str]:
        if row.quantity != DISTANCE:
            return estimate_text(row.first), estimate_text(row.second)
        first, second = (self._comparison.tests.figure(test, row.lines[0], row.word) for test in (0, 1))
        return cell_text(first), cell_text(second)


def row_name(comparison: Comparison, row: Row) -> str:
    """Return the line, the side, or the run of lines of a row."""
    if row.line is not None:
        return f"{row.line} ({domain_word(comparison.tests.results[0][row.line].place)})"
    if row.quantity == NEIGHBOURS:
        return translate("Comparison", "{first} to {last}, moved together").format(first=row.lines[0],
                                                                              last=row.lines[-1])
    return translated(row.name)


def words_text(row: Row) -> str:
    """Return the names of the distances of a row."""
    return ", ".join(map(domain_word, row.words))


def result_text(row: Row) -> str:
    """Return the result for a row alone, with a star if it also differs among all."""
    return f"{change_text(row.change)} *" if row.is_different else change_text(row.change)


def change_text(change: Change) -> str:
    """Return the result for one quantity."""
    return {Change.FARTHER: translate("Comparison", "farther"), Change.NEARER: translate("Comparison", "nearer"),
            Change.NOT_SHOWN: translate("Comparison", "no difference shown"),
            Change.NOT_KNOWN: translate("Comparison", "not known")}[change]
