"""One word with a colour: can a test be started? A click lists the reasons, and everything that is looked at."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QPushButton, QVBoxLayout, QWidget

from mtr_operator.station.checks.finding import Item
from mtr_operator.station.readiness import Cause, Readiness, ReadinessWord

from ..stopping import Stopping
from ..theme.state import show_state
from .checklist_panel import ChecklistPanel
from .popup import Popup
from .preflight_details import PreflightDetails
from .reasons import advice_text, reason_text, word_text

# Told apart without colours too.
_SIGNS = {
    ReadinessWord.READY: "\N{CHECK MARK}",
    ReadinessWord.WARNINGS: "!",
    ReadinessWord.NOT_READY: "\N{MULTIPLICATION X}",
    ReadinessWord.MEASURING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.PAUSED: "\N{DOUBLE VERTICAL LINE}",
    ReadinessWord.LOST: "\N{MULTIPLICATION X}",
    ReadinessWord.DRIVING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.MAPPING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.CHECKING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.BLOCKED: "\N{MULTIPLICATION X}",
}


_LIST_WIDTH = 680


class StatusWord(QPushButton):
    """Attributes: popup: the list of reasons. checklist: below them, what has to be right before the robot moves.

    preflight: below it, its sentences. events: below them, the way to the event list. Signals: events_wanted.
    """

    events_wanted = pyqtSignal()

    def __init__(self, stopping: Stopping, parent: QWidget | None = None):
        super().__init__(parent)
        self.popup = Popup(self, stopping)
        self.checklist = ChecklistPanel()
        self.preflight = PreflightDetails()
        self.preflight.toggled.connect(self.popup.fit)
        self.events = QPushButton(self.tr("All events"))
        self.events.setProperty("role", "flat")
        self.events.clicked.connect(self._want_events)
        self.popup.widen(_LIST_WIDTH, self._below())
        self._items: tuple[Item, ...] = ()
        self._readiness: Readiness | None = None
        self.clicked.connect(self._open)

    def show_readiness(self, readiness: Readiness) -> None:
        """Show another readiness."""
        if readiness == self._readiness:
            return
        word_changed = self._readiness is None or readiness.word is not self._readiness.word
        self._readiness = readiness
        word = word_text(readiness.word)
        if word_changed:
            self.setText(f"{_SIGNS[readiness.word]}  {word}")
            show_state(self, "word", readiness.word.value)
        sentences = [reason_text(reason) for reason in readiness.reasons]
        self.setAccessibleName(self.tr("Status: {word}").format(word=word))
        self.setAccessibleDescription(" ".join(sentences))
        self.setToolTip("\n".join(sentences) or self.tr("Everything is ready for a test."))
        if self.popup.isVisible():
            self._fill()

    def show_checklist(self, items: tuple[Item, ...]) -> None:
        """Show another checklist."""
        self._items = items
        if self.popup.isVisible():
            self._show_items()

    def _show_items(self) -> None:
        self.checklist.show_items(self._items)
        self.preflight.show_items(self._items)

    def _below(self) -> QWidget:
        holder = QWidget()
        column = QVBoxLayout(holder)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.checklist)
        column.addWidget(self.preflight)
        column.addWidget(self.events)
        return holder

    def _want_events(self) -> None:
        self.popup.hide()
        self.events_wanted.emit()

    def _open(self) -> None:
        self._show_items()
        self._fill()
        self.popup.open_below(self)

    def _fill(self) -> None:
        readiness = self._readiness
        if readiness is None:
            return
        # The checklist has the others.
        entries = [(reason_text(reason), advice_text(reason)) for reason in readiness.reasons
                   if reason.cause in (Cause.HELD, Cause.WAY_BLOCKED)]
        self.popup.fill(word_text(readiness.word), entries)
