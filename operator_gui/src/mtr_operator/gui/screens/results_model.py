"""Results of a test as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

from PyQt5.QtCore import QAbstractTableModel, QModelIndex, Qt

from mtr_operator.domain.scenario import REASON, LineStatus, Measurement, Result

from ..i18n import number
from ..names import domain_word
from ..pictures.protocol_picture import Protocol
from ..sentences import translated

_CM_PER_M = 100.0
_FIXED_COLUMNS = 2
PLACE_COLUMN = 1


class ResultsModel(QAbstractTableModel):
    """Number and place of each line, then distance and uncertainty of each measurement in cm."""

    def __init__(self, protocol: Protocol, parent=None):
        super().__init__(parent)
        self._scenario = protocol.scenario
        self._results = protocol.progress.results

    def rowCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else len(self._results)

    def columnCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else _FIXED_COLUMNS + 2 * len(self._scenario.measurements)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        if role != Qt.DisplayRole or orientation != Qt.Horizontal:
            return None
        if section < _FIXED_COLUMNS:
            return ("#", domain_word(self._scenario.line_word).capitalize())[section]
        measurement = self._measurement(section)
        word = domain_word(measurement.word).capitalize()
        return f"{word} [cm]" if self._is_distance(section) else "\N{PLUS-MINUS SIGN}"

    def data(self, index: QModelIndex, role: int = Qt.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        result = self._results[index.row()]
        if role == Qt.DisplayRole:
            return self._text(result, index.column())
        if role == Qt.TextAlignmentRole and index.column() >= _FIXED_COLUMNS:
            return int(Qt.AlignRight | Qt.AlignVCenter)
        if role == Qt.ToolTipRole:
            return translated(result[REASON]) or None
        return None

    def _text(self, result: Result, column: int) -> str:
        if column < _FIXED_COLUMNS:
            return (str(self._scenario.number_of(result)), domain_word(self._scenario.place_of(result)))[column]
        measurement = self._measurement(column)
        status = result[measurement.status]
        value = result[measurement.distance if self._is_distance(column) else measurement.uncertainty]
        if self._is_distance(column) and status != LineStatus.OK.value:
            return domain_word(status.replace("_", " "))
        return "" if value is None else number(value * _CM_PER_M, 1)

    def _measurement(self, column: int) -> Measurement:
        return self._scenario.measurements[(column - _FIXED_COLUMNS) // 2]

    @staticmethod
    def _is_distance(column: int) -> bool:
        return (column - _FIXED_COLUMNS) % 2 == 0
