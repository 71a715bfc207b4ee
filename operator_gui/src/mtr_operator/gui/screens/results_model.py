"""Results of a test as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

from PyQt5.QtCore import QAbstractTableModel, QModelIndex, QObject, Qt

from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance, has_intervals

from ..i18n import number
from ..names import domain_word
from ..pictures.protocol_picture import Protocol
from ..sentences import translated

_CM_PER_M = 100.0
_FIXED_COLUMNS = 2
# Columns of each distance.
_DISTANCE, _INTERVAL = 0, 2


class ResultsModel(QAbstractTableModel):
    """Number and place of each line, then distance, uncertainty and perhaps interval of each measurement in cm; at the
    end the verdict, where there are limits."""

    def __init__(self, protocol: Protocol, parent: QObject | None = None):
        super().__init__(parent)
        self._scenario = protocol.scenario
        self._results = protocol.progress.results
        self._kinds = 3 if has_intervals(self._results) else 2
        self._judgement = protocol.assessment.judgement
        self._verdict_column = _FIXED_COLUMNS + self._kinds * len(self._scenario.distance_words)

    def rowCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else len(self._results)

    def columnCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else self._verdict_column + (self._judgement is not None)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        if role != Qt.ItemDataRole.DisplayRole or orientation != Qt.Orientation.Horizontal:
            return None
        if section < _FIXED_COLUMNS:
            return ("#", domain_word(self._scenario.line_word).capitalize())[section]
        if section == self._verdict_column:
            return domain_word("verdict").capitalize()
        word = domain_word(self._scenario.distance_words[self._index(section)]).capitalize()
        return (f"{word} [cm]", "\N{PLUS-MINUS SIGN}", "95 %")[self._kind(section)]

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
        distance, kind = result.distances[self._index(column)], self._kind(column)
        if kind == _INTERVAL:
            return interval_text(distance)
        if kind == _DISTANCE and distance.status is not LineStatus.OK:
            return domain_word(distance.status.value.replace("_", " "))
        value = distance.distance_m if kind == _DISTANCE else distance.uncertainty_m
        return "" if value is None else number(value * _CM_PER_M, 1)

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


def interval_text(distance: MeasuredDistance) -> str:
    """Ends in cm; an inequality where the boundary lies beyond the other one."""
    low, high = ("" if end is None else number(end * _CM_PER_M, 0) for end in (distance.low_m, distance.high_m))
    if low and high:
        return f"{low}\N{EN DASH}{high}"
    return f"> {low}" if low else f"< {high}" if high else ""
