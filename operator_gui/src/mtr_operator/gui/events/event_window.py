"""The event list: the robot's log, changes of the locks, faults, answers and orders, filtered."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.eventlog.entry import ERROR, INFO, WARNING, EventEntry, EventKind
from mtr_operator.domain.eventlog.event_list import MAX_KEPT, event_filter
from mtr_operator.storage.recorded.event_file import read_events
from mtr_operator.storage.recorded.recording import recorded_events, recording_folder

from ..fitting.breaks import breakable
from ..fitting.place import open_within
from ..fitting.plain_table import plain_table
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import M, S
from .event_model import EventModel, kind_text

_SIZE = QSize(1080, 680)
_TABLE_HEIGHT = 200
_BOX_LETTERS = 10


class EventWindow(QDialog):
    """Grows while it is open; a list that is scrolled stays where it is.

    Attributes: of: whether that of now or that of the test at hand is shown, as it was kept with it. kind, severity,
    search: the filter. table. notice: how many there are, and where they are kept.
    """

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Events"))
        self._flow = flow
        self._seen = 0
        self._model = EventModel(appearance, self)
        self.of = self._box(self.tr("Which events"), ((self.tr("Since the start"), False),
                                                      (self.tr("Of the test"), True)))
        self.kind = self._box(self.tr("Kind"), ((self.tr("All kinds"), None),
                                                *((kind_text(kind), kind) for kind in EventKind)))
        self.severity = self._box(self.tr("Severity"), ((self.tr("All"), INFO), (self.tr("Warnings"), WARNING),
                                                        (self.tr("Errors"), ERROR)))
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Search"))
        self.search.setAccessibleName(self.tr("Search"))
        self.table = self._make_table()
        self.notice = QLabel()
        self.notice.setWordWrap(True)
        self.notice.setProperty("role", "soft")
        self._lay_out()
        self.of.currentIndexChanged.connect(self._begin)
        for box in (self.kind, self.severity):
            box.currentIndexChanged.connect(self._filter)
        self.search.textChanged.connect(self._filter)
        flow.bridge.changed.connect(self.refresh)
        self._begin()
        self.ensurePolished()
        open_within(self, _SIZE)

    @staticmethod
    def _box(title: str, entries: tuple[tuple[str, object], ...]) -> QComboBox:
        box = QComboBox()
        box.setAccessibleName(title)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(_BOX_LETTERS)
        for text, value in entries:
            box.addItem(text, value)
        return box

    def _make_table(self) -> QTableView:
        table = plain_table(self.tr("Events, the newest first"), _TABLE_HEIGHT)
        table.setModel(self._model)
        # Of ten thousand rows only those in sight are measured.
        table.horizontalHeader().setResizeContentsPrecision(0)
        table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        return table

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.clicked.connect(self.accept)
        close.setAutoDefault(False)
        filters = QHBoxLayout()
        filters.setSpacing(S)
        for widget in (self.of, self.kind, self.severity, self.search):
            filters.addWidget(widget, 1)
        column = QVBoxLayout()
        column.setSpacing(S)
        column.addLayout(filters)
        column.addWidget(self.table, 1)
        row = QHBoxLayout()
        row.setSpacing(M)
        row.addWidget(self.notice, 1)
        row.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(row)

    def refresh(self) -> None:
        """Show what has come since."""
        events = self._flow.model.events
        if self._is_of_test or events.count == self._seen:
            return
        self._model.append(events.since(self._seen), MAX_KEPT)
        self._seen = events.count
        self._say(self._counted)

    @property
    def _is_of_test(self) -> bool:
        return bool(self.of.currentData())

    @property
    def _counted(self) -> str:
        return self.tr("{count} events, {shown} of them shown.").format(count=self._model.total,
                                                                       shown=self._model.rowCount())

    def _begin(self) -> None:
        """Another list."""
        if self._is_of_test:
            self._show_kept()
            return
        events = self._flow.model.events
        self._model.show_entries(events.entries)
        self._seen = events.count
        self._say(self._counted)

    def _show_kept(self) -> None:
        test = self._flow.model.test
        folder = None if test is None else recording_folder(test.path)
        self._model.show_entries([])
        try:
            self._model.show_entries(() if folder is None else _kept(folder))
        except OperatorError as error:
            self._say(translated(str(error)))
        else:
            self._say(self.tr("No test is at hand.") if folder is None else
                      self._counted + " " + self.tr("They are kept in {folder}.").format(folder=folder))

    def _filter(self) -> None:
        self._model.use_filter(event_filter(self.kind.currentData(), self.severity.currentData(), self.search.text()))
        self._say(self._counted)

    def _say(self, sentence: str) -> None:
        self.notice.setText(breakable(sentence))


def _kept(folder: pathlib.Path) -> list[EventEntry]:
    """The event lists of all runs of a test."""
    return [entry for path in recorded_events(folder) for entry in read_events(path)]
