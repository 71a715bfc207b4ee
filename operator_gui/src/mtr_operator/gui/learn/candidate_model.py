"""What followed the locks, as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt

from mtr_operator.car_link.learn.database_names import DatabaseNames
from mtr_operator.car_link.learn.findings import Candidate, Findings
from mtr_operator.car_link.learn.words import besides, cells

from ..history.table_model import TableModel
from ..sentences import translated

_BESIDES = 7


class CandidateModel(TableModel):
    """The most likely one first."""

    def __init__(self, findings: Findings, parent: QObject | None = None, names: DatabaseNames | None = None):
        """names: by which the last column names what it knows."""
        super().__init__(parent)
        self._findings, self._names = findings, names

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        candidate = self._findings.candidates[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            if index.column() == _BESIDES:
                return ", ".join(map(translated, besides(candidate, self._names)))
            return cells(candidate, self._findings.stays)[index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole and 0 < index.column() < _BESIDES:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _rows(self) -> Sequence[Candidate]:
        return self._findings.candidates

    def _headings(self) -> tuple[str, ...]:
        return (self.tr("Identifier"), self.tr("Byte.bits"), self.tr("Locked"), self.tr("Unlocked"),
                self.tr("Followed"), self.tr("Later by"), self.tr("Cycle"), self.tr("Besides"))
