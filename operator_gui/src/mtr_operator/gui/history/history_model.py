"""Tests of before as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.history.entry import TestEntry

from ..names import domain_word, scenario_title
from ..sentences import translated
from .table_model import TableModel

_LINES = 2
_NONE = "\N{EN DASH}"


class HistoryModel(TableModel):
    """When, which scenario, how many lines, verdict, car, key, operator, place; of what cannot be read the file, with
    why as its tip. Attributes: entries: a row each."""

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.entries: Sequence[TestEntry] = ()

    def show_entries(self, entries: Sequence[TestEntry]) -> None:
        """Show these."""
        self.beginResetModel()
        self.entries = tuple(entries)
        self.endResetModel()

    def _rows(self) -> Sequence[TestEntry]:
        return self.entries

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        entry = self.entries[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._texts(entry)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return translated(entry.problem) or (self.tr("In the store {where}, as test {number}").format(
                where=entry.store, number=entry.path) if entry.store else entry.path)
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() == _LINES:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _headings(self) -> tuple[str, ...]:
        return (self.tr("Begun"), self.tr("Scenario"), self.tr("Lines"), self.tr("Verdict"), self.tr("Car"),
                self.tr("Key"), self.tr("Operator"), self.tr("Place"))

    def _texts(self, entry: TestEntry) -> tuple[str, ...]:
        if entry.problem:
            return (_NONE, self.tr("cannot be read"), "", _NONE, "", "", "", entry.file.name)
        # A list that a later version has kept may name a scenario of its own.
        scenario = SCENARIOS.get(entry.scenario)
        return (entry.moment, entry.scenario if scenario is None else scenario_title(scenario),
                f"{entry.done}/{entry.total or '?'}", domain_word(entry.verdict) if entry.verdict else _NONE,
                entry.car, entry.key, entry.operator, entry.place)
