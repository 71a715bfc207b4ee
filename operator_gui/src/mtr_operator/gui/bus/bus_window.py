"""The live view of the Car's bus: its load, each message, and the locks beside the key's distance."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QSize, QTimer
from PyQt5.QtGui import QHideEvent, QShowEvent
from PyQt5.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.station.bus.bus_view import BusView

from ..fitting.place import open_within
from ..fitting.plain_table import plain_table
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..i18n import number
from ..names import locks_text
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import M, S
from ..theme.state import show_state
from .message_model import MessageModel
from .time_line_view import TimeLineView

_SIZE = QSize(980, 760)
_TABLE_HEIGHT = 200
# Faster than anybody reads.
_PERIOD_MS = 200


class BusWindow(QDialog):
    """Looks while it is shown, and costs nothing else.

    Attributes: summary: load and number of messages, or why there are none. table: the messages. time_line: the last
    minute. newest: the last change of the locks in words.
    """

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Live bus view"))
        self._flow = flow
        self.summary = Prose()
        self._model = MessageModel(appearance, self)
        self.table = self._make_table()
        self.time_line = TimeLineView(appearance)
        self.newest = Prose()
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD_MS)
        self._timer.timeout.connect(self.refresh)
        self._lay_out()
        self.refresh()
        self.ensurePolished()
        open_within(self, _SIZE)

    def _make_table(self) -> QTableView:
        table = plain_table(self.tr("Messages of the bus"), _TABLE_HEIGHT)
        table.setModel(self._model)
        # Of the rows that are seen alone: a bus has hundreds, and their widths are asked for five times a second.
        table.horizontalHeader().setResizeContentsPrecision(0)
        return table

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.setDefault(True)
        close.clicked.connect(self.accept)
        heading = QLabel(self.tr("The Car's locks, and below them the key's distance from the Car's outline"))
        heading.setWordWrap(True)
        heading.setProperty("role", "soft")
        column = QVBoxLayout()
        column.setSpacing(S)
        column.addWidget(self.summary)
        column.addWidget(self.table, 1)
        column.addWidget(heading)
        column.addWidget(self.time_line)
        column.addWidget(self.newest)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(row)

    def showEvent(self, event: QShowEvent) -> None:
        """See QWidget."""
        super().showEvent(event)
        self.refresh()
        self._timer.start()

    def hideEvent(self, event: QHideEvent) -> None:
        """See QWidget."""
        self._timer.stop()
        super().hideEvent(event)

    def refresh(self) -> None:
        """Show what is so now."""
        view = self._flow.bus_view()
        self.summary.setText(self._summary(view))
        self._model.show_messages(() if view.messages is None else view.messages.messages)
        self.time_line.show_moments(view.moments, view.events)
        self.newest.setText(self._newest(view))
        self.time_line.setAccessibleDescription(self.newest.text())
        show_state(self.newest, "stale", self._flow.model.is_stale)

    def _summary(self, view: BusView) -> str:
        if view.messages is None:
            nobody = self.tr("There is no bus: the Car is a substitute inside the application.")
            return translated(view.problem) or nobody
        parts = [translated(view.problem)] if view.problem else []
        load = 0.0 if view.traffic is None else view.traffic.load
        parts.append(self.tr("Load {load} %, {count} messages.").format(
            load=number(100.0 * load, 0), count=len(view.messages.messages)))
        if view.messages.others:
            parts.append(self.tr("{count} frames of further messages are not shown.").format(
                count=view.messages.others))
        if view.traffic is not None and view.traffic.stamps:
            parts.append(self.tr("Frames are timed by {clock}.").format(clock=translated(view.traffic.stamps)))
        return " ".join(parts)

    def _newest(self, view: BusView) -> str:
        if not view.moments:
            return self.tr("Nothing is known of the locks yet.")
        now = view.moments[-1]
        parts = [self.tr("Now: {locks}.").format(locks=locks_text(now.lock_state)) if now.gap_m is None else
                 self.tr("Now: {locks}, key at {distance} m.").format(
                     locks=locks_text(now.lock_state), distance=number(now.gap_m, 2))]
        if view.events:
            event = view.events[-1]
            words = {"locks": locks_text(event.lock_state), "age": number(max(now.stamp_s - event.time_s, 0.0), 1)}
            parts.append(self.tr("Last change {age} s ago: {locks}.").format(**words) if event.gap_m is None else
                         self.tr("Last change {age} s ago: {locks}, key at {distance} m.").format(
                             distance=number(event.gap_m, 2), **words))
        return " ".join(parts)
