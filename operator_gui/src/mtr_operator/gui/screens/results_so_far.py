"""What is measured so far, beside the picture of a running test, where a screen is high enough for it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt
from PyQt5.QtWidgets import QTableView, QVBoxLayout, QWidget

from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.report.figures import figures_of
from mtr_operator.station.test import Test
from mtr_operator.station.view_model import ViewModel

from ..figure_text import cell_text
from ..fitting.plain_table import plain_table
from ..history.table_model import TableModel
from ..names import domain_word

_TABLE_HEIGHT = 160
_FIXED_COLUMNS = 2


class ResultsSoFarModel(TableModel):
    """Number and place of each line and its distances in m, the newest first."""

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._test: Test | None = None
        self._results: Sequence[LineResult] = ()

    def show_results(self, test: Test, results: Sequence[LineResult]) -> None:
        """Show these of a test."""
        self.beginResetModel()
        self._test, self._results = test, tuple(reversed(results))
        self.endResetModel()

    def _rows(self) -> Sequence[LineResult]:
        return self._results

    def _headings(self) -> tuple[str, ...]:
        if self._test is None:
            return ()
        scenario = self._test.scenario
        words = (f"{domain_word(word).capitalize()} [m]" for word in scenario.distance_words)
        return ("#", domain_word(scenario.line_word).capitalize(), *words)

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(self._results[index.row()], index.column())
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() >= _FIXED_COLUMNS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _text(self, result: LineResult, column: int) -> str:
        if column < _FIXED_COLUMNS or self._test is None:
            return (str(result.number), domain_word(result.place))[column]
        figures = figures_of(self._test.scenario, self._test.parameters, result)
        distance = column - _FIXED_COLUMNS
        return cell_text(figures[distance], result.distances[distance].uncertainty_m) if distance < len(figures) else ""


class ResultsSoFar(QWidget):
    """Attributes: table."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._model = ResultsSoFarModel(self)
        self._shown: tuple[object, ...] = ()
        self.table = plain_table(self.tr("What is measured so far, the newest first"), _TABLE_HEIGHT)
        self.table.setModel(self._model)
        self.table.setSelectionMode(QTableView.NoSelection)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.table)

    def show_model(self, model: ViewModel) -> None:
        """Show the newest; a Status without a new result costs nothing."""
        now = (model.current_test, model.results)
        if now != self._shown:
            self._shown = now
            self._model.show_results(model.current_test, model.results)
