"""Differences of two tests as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt

from mtr_operator.history.comparison import Change, Comparison, Difference

from ..figure_text import cell_text
from ..i18n import number, translate
from ..names import domain_word
from ..sentences import translated
from .table_model import TableModel

# Columns of words; after them come figures.
_WORDS = 3


class ComparisonModel(TableModel):
    """Line, distance, what may be said of it; second test less first, its 95 % interval, and what both tests say."""

    def __init__(self, comparison: Comparison, parent: QObject | None = None):
        super().__init__(parent)
        self._comparison = comparison

    def _rows(self) -> Sequence[Difference]:
        return self._comparison.differences

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        difference = self._comparison.differences[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._texts(difference)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return translated(difference.reason) or None
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() >= _WORDS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _headings(self) -> tuple[str, ...]:
        return (domain_word(self._comparison.first.scenario.line_word).capitalize(), "", self.tr("Second test"),
                self.tr("Difference [m]"), "95 % [m]", self.tr("First [m]"), self.tr("Second [m]"))

    @staticmethod
    def _texts(difference: Difference) -> tuple[str, ...]:
        pair = difference.pair
        value = "" if difference.value_m is None else signed(difference.value_m)
        return (f"{pair.number} ({domain_word(pair.first.place)})", domain_word(difference.word),
                change_text(difference.change), value, "" if difference.reason else ends_text(difference),
                cell_text(difference.first), cell_text(difference.second))


def change_text(change: Change) -> str:
    """What may be said of a difference."""
    return {Change.FARTHER: translate("Comparison", "farther"), Change.NEARER: translate("Comparison", "nearer"),
            Change.NOT_SHOWN: translate("Comparison", "no difference shown"),
            Change.NOT_KNOWN: translate("Comparison", "not known")}[change]


def signed(value_m: float) -> str:
    """With its sign, also a plus."""
    return ("+" if value_m >= 0.0 else "\N{MINUS SIGN}") + number(abs(value_m), 2)


def ends_text(difference: Difference) -> str:
    """The interval, or the end that is known."""
    low_m, high_m = difference.low_m, difference.high_m
    if math.isfinite(low_m) and math.isfinite(high_m):
        return translate("Figure", "{first} to {second}").format(first=signed(low_m), second=signed(high_m))
    if math.isfinite(low_m):
        return translate("Figure", "at least {first}").format(first=signed(low_m))
    return translate("Figure", "at most {first}").format(first=signed(high_m)) if math.isfinite(high_m) else ""
