"""Results of a test as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

from PyQt5.QtCore import QAbstractTableModel, QModelIndex, QObject, Qt

from mtr_operator.domain.results.line_result import LineResult, has_intervals
from mtr_operator.report.figures import INTERVAL, figures_of, meanings

from ..figure_text import cell_text, interval_text, sigma_heading, sigma_text
from ..names import domain_word
from ..pictures.protocol_picture import Protocol
from ..sentences import translated

_FIXED_COLUMNS = 2
# Columns of each distance.
_DISTANCE, _INTERVAL = 0, 2


class ResultsModel(QAbstractTableModel):
    """Number and place of each line, then distance, uncertainty and perhaps interval of each measurement in m, what
    else lines tell where they do, and at the end the verdict, where there are limits."""

    def __init__(self, protocol: Protocol, parent: QObject | None = None):
        super().__init__(parent)
        self._scenario = protocol.scenario
        self._parameters = protocol.parameters
        self._results = protocol.progress.results
        self._kinds = 3 if has_intervals(self._results) else 2
        self._judgement = protocol.assessment.judgement
        self._finding_column = _FIXED_COLUMNS + self._kinds * len(self._scenario.distance_words)
        self._verdict_column = self._finding_column + any(result.findings for result in self._results)

    def rowCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else len(self._results)

    def columnCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else self._verdict_column + (self._judgement is not None)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        if role == Qt.ItemDataRole.ToolTipRole and section >= _FIXED_COLUMNS:
            return "\n".join(map(translated, meanings(self._results))) or None
        if role != Qt.ItemDataRole.DisplayRole or orientation != Qt.Orientation.Horizontal:
            return None
        if section < _FIXED_COLUMNS:
            return ("#", domain_word(self._scenario.line_word).capitalize())[section]
        if section == self._verdict_column:
            return domain_word("verdict").capitalize()
        if section >= self._finding_column:
            return domain_word("finding").capitalize()
        word = domain_word(self._scenario.distance_words[self._index(section)]).capitalize()
        return (f"{word} [m]", sigma_heading(self._results), f"{INTERVAL} [m]")[self._kind(section)]

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        result = self._results[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(result, index.column())
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() >= _FIXED_COLUMNS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if role == Qt.ItemDataRole.ToolTipRole:
            return translated(self._reason(result, index.column())) or None
        return None

    def _text(self, result: LineResult, column: int) -> str:
        if column < _FIXED_COLUMNS:
            return (str(result.number), domain_word(result.place))[column]
        if self._judgement is not None and column == self._verdict_column:
            return domain_word(self._judgement.of_line(result.number).word.replace("_", " "))
        if column >= self._finding_column:
            return "; ".join(map(translated, result.findings))
        distance, kind = result.distances[self._index(column)], self._kind(column)
        if kind == _INTERVAL:
            return interval_text(distance)
        if kind == _DISTANCE:
            figure = figures_of(self._scenario, self._parameters, result)[self._index(column)]
            return cell_text(figure, distance.uncertainty_m)
        return sigma_text(distance.uncertainty_m)

    def _reason(self, result: LineResult, column: int) -> str:
        """Why the line is invalid, or did not pass."""
        if self._judgement is not None and column == self._verdict_column:
            return self._judgement.reason_of(result.number)
        return result.reason

    def _index(self, column: int) -> int:
        """Index of the distance that a column belongs to."""
        return (column - _FIXED_COLUMNS) // self._kinds

    def _kind(self, column: int) -> int:
        return (column - _FIXED_COLUMNS) % self._kinds
