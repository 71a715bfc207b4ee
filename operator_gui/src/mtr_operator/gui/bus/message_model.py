"""The messages of the Car's bus as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt
from PyQt5.QtGui import QColor

from mtr_operator.domain.ports import BusMessage

from ..history.table_model import TableModel
from ..i18n import number
from ..theme.appearance import Appearance

_MS_PER_S = 1000.0
# A message counts as gone when so many of its cycles are missing, and never before this time.
_MISSING_CYCLES, _MIN_GONE_S = 5.0, 1.0
_NUMBERS = (2, 3, 4)
_ID_DIGITS = {False: 3, True: 8}
_UNKNOWN = "\N{EN DASH}"


class MessageModel(TableModel):
    """Identifier, name, frames, cycle, age and newest data of each message; one that comes no more is grey."""

    def __init__(self, appearance: Appearance, parent: QObject | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._messages: Sequence[BusMessage] = ()

    def show_messages(self, messages: Sequence[BusMessage]) -> None:
        """Show these; the chosen row stays while no message comes new."""
        is_same = [_key(message) for message in messages] == [_key(message) for message in self._messages]
        if not is_same:
            self.beginResetModel()
        self._messages = messages
        if not is_same:
            self.endResetModel()
        elif messages:
            self.dataChanged.emit(self.index(0, 0), self.index(len(messages) - 1, len(self._headings()) - 1))

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        message = self._messages[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return _texts(message)[index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() in _NUMBERS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if role == Qt.ItemDataRole.ForegroundRole and is_gone(message):
            return QColor(self._appearance.palette.ink_soft)
        return None

    def _rows(self) -> Sequence[BusMessage]:
        return self._messages

    def _headings(self) -> tuple[str, ...]:
        return (self.tr("Identifier"), self.tr("Message"), self.tr("Frames"), self.tr("Cycle [ms]"),
                self.tr("Age [s]"), self.tr("Newest data"))


def is_gone(message: BusMessage) -> bool:
    """True when it should have come again long since."""
    cycle_s = message.cycle_s or 0.0
    return message.age_s > max(_MISSING_CYCLES * cycle_s, _MIN_GONE_S)


def _key(message: BusMessage) -> tuple[int, bool]:
    return message.can_id, message.is_extended


def _texts(message: BusMessage) -> tuple[str, ...]:
    cycle = _UNKNOWN if message.cycle_s is None else number(message.cycle_s * _MS_PER_S, 1)
    return (f"{message.can_id:0{_ID_DIGITS[message.is_extended]}X}", message.name or _UNKNOWN, str(message.count),
            cycle, number(message.age_s, 1), message.data.hex(" ").upper())
