"""What would change in a test of before with the car profile as it is now: a table of its distances."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, QSize, Qt
from PyQt5.QtWidgets import QDialog, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance

from ..fitting.place import open_within
from ..fitting.plain_table import plain_table
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..i18n import number
from ..names import domain_word
from ..sentences import translated
from ..theme.scale import M
from .table_model import TableModel

if TYPE_CHECKING:
    from mtr_operator.replay.replay import ReplayedTest

_SIZE = QSize(900, 640)
_TABLE_HEIGHT = 200
# What results.csv shows is a tenth of a millimetre.
_DIGITS = 4


class ReplayModel(TableModel):
    """Line, distance, as recorded, as now; those that changed first."""

    def __init__(self, found: ReplayedTest, parent: QObject | None = None):
        super().__init__(parent)
        changed = [(result.number, former.word) for result, former, _ in found.changed_lines]
        every = [(old, former, now) for old, new in zip(found.recorded, found.now)
                 for former, now in zip(old.distances, new.distances)]
        self._found = sorted(every, key=lambda row: (row[0].number, row[1].word) not in changed)
        self._changed = len(changed)

    def _rows(self) -> Sequence[tuple[LineResult, MeasuredDistance, MeasuredDistance]]:
        return self._found

    def _headings(self) -> tuple[str, ...]:
        return (self.tr("Line"), "", self.tr("In the record [m]"), self.tr("Now [m]"), "")

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        result, former, now = self._found[index.row()]
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        change = self.tr("would change") if index.row() < self._changed else ""
        return (f"{result.number} ({domain_word(result.place)})", domain_word(former.word), _text(former), _text(now),
                change)[index.column()]


class ReplayWindow(QDialog):
    """Attributes: table: the distances. summary: what came out."""

    def __init__(self, name: str, found: ReplayedTest, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Computed anew: {name}").format(name=name))
        self.table = plain_table(self.tr("Distances as recorded and as they would be now"), _TABLE_HEIGHT)
        self.table.setModel(ReplayModel(found, self))
        self.summary = Prose(self._summary(found))
        close = QPushButton(self.tr("Close"))
        close.setDefault(True)
        close.clicked.connect(self.accept)
        column, below = QVBoxLayout(), QHBoxLayout()
        column.setSpacing(M)
        column.addWidget(self.summary)
        column.addWidget(self.table, 1)
        below.addStretch(1)
        below.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(below)
        self.ensurePolished()
        open_within(self, _SIZE)

    def _summary(self, found: ReplayedTest) -> str:
        distances = sum(len(result.distances) for result in found.recorded)
        said = self.tr("From the recorded log, the robot's poses and the car profile as it is now: {changed} of "
                       "{count} distances would change; the largest difference is {worst} mm.")
        return "\n".join([said.format(changed=len(found.changed_lines), count=distances,
                                      worst=number(found.worst_m * 1000.0, 1)), *map(translated, found.notices)])


def _text(distance: MeasuredDistance) -> str:
    if distance.distance_m is not None:
        return number(distance.distance_m, _DIGITS)
    return domain_word(distance.status.value.replace("_", " ")) if distance.status is not LineStatus.OK else \
        " \N{EN DASH} ".join("" if end is None else number(end, _DIGITS) for end in (distance.low_m, distance.high_m))
