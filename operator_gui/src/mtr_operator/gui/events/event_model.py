"""The event list as a table, the newest entry first."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterable, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt
from PyQt5.QtGui import QColor

from mtr_operator.domain.eventlog.entry import APPLICATION, CAR, ERROR, INFO, ROBOT, WARNING, EventEntry, EventKind
from mtr_operator.domain.eventlog.event_list import EventFilter

from ..history.table_model import TableModel
from ..i18n import translate
from ..sentences import translated
from ..theme.appearance import Appearance

_TIME = "%H:%M:%S"
_SENTENCE = 4
# Told apart without colours too.
_SIGNS = {INFO: "", WARNING: "!", ERROR: "\N{MULTIPLICATION X}"}


class EventModel(TableModel):
    """Time, sign of the severity, kind, source and sentence of each entry that the filter takes."""

    def __init__(self, appearance: Appearance, parent: QObject | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._filter = EventFilter()
        self._all: list[EventEntry] = []
        self._shown: list[EventEntry] = []

    @property
    def total(self) -> int:
        """Entries, whether they are shown or not."""
        return len(self._all)

    def show_entries(self, entries: Sequence[EventEntry]) -> None:
        """Show another list; entries: the oldest first."""
        self._all = list(entries)
        self._begin_anew()

    def use_filter(self, wanted: EventFilter) -> None:
        """Show what another filter takes."""
        self._filter = wanted
        self._begin_anew()

    def append(self, entries: Iterable[EventEntry], most: int) -> None:
        """The list has grown; of what is older than so many nothing stays."""
        fresh = list(entries)
        self._all = (self._all + fresh)[-most:]
        taken = [entry for entry in reversed(fresh) if self._takes(entry)]
        if len(self._shown) + len(taken) > most:
            self._begin_anew()
        elif taken:
            self.beginInsertRows(QModelIndex(), 0, len(taken) - 1)
            self._shown = taken + self._shown
            self.endInsertRows()

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        entry = self._shown[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return _texts(entry)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole and index.column() == _SENTENCE:
            return translated(entry.text)
        if role == Qt.ItemDataRole.ForegroundRole and entry.severity > INFO:
            palette = self._appearance.palette
            return QColor(palette.danger if entry.severity >= ERROR else palette.warning)
        return None

    def _begin_anew(self) -> None:
        self.beginResetModel()
        self._shown = [entry for entry in reversed(self._all) if self._takes(entry)]
        self.endResetModel()

    def _takes(self, entry: EventEntry) -> bool:
        return self._filter.takes(entry, translated(entry.text))

    def _rows(self) -> Sequence[EventEntry]:
        return self._shown

    def _headings(self) -> tuple[str, ...]:
        return (self.tr("Time"), "", self.tr("Kind"), self.tr("Source"), self.tr("What happened"))


def kind_text(kind: EventKind) -> str:
    """What an entry is about, in a word."""
    return {EventKind.ROBOT_LOG: translate("Event", "Robot's log"), EventKind.FAULT: translate("Event", "Fault"),
            EventKind.ANSWER: translate("Event", "Answer"), EventKind.LOCKS: translate("Event", "Locks"),
            EventKind.TEST: translate("Event", "Test"), EventKind.OPERATOR: translate("Event", "Operator")}[kind]


def _texts(entry: EventEntry) -> tuple[str, ...]:
    source = {ROBOT: translate("Event", "robot"), CAR: translate("Event", "Car"),
              APPLICATION: translate("Event", "application")}.get(entry.source, entry.source)
    return (entry.time.astimezone().strftime(_TIME), _SIGNS[entry.severity], kind_text(entry.kind), source,
            _begun_large(translated(entry.text)))


def _begun_large(sentence: str) -> str:
    """What a running test says of itself goes on from its title elsewhere; in the list each stands alone."""
    return sentence[:1].upper() + sentence[1:]
