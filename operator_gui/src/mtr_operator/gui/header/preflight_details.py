"""All sentences of the robot's last preflight, when somebody asks for them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.station.checks.finding import Check, Item

from ..theme.scale import XS
from .checklist_panel import sign_of


class PreflightDetails(QWidget):
    """A button, and below it the sentences; hidden where there are none. Signals: toggled: its height has changed."""

    toggled = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._item: Item | None = None
        self.button = QPushButton()
        self.button.setCheckable(True)
        self.button.setProperty("role", "flat")
        self.button.toggled.connect(self._suit)
        self.sentences = QLabel()
        self.sentences.setWordWrap(True)
        self.sentences.setTextFormat(Qt.TextFormat.PlainText)
        # To be copied into a message to who mends the robot.
        self.sentences.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(XS)
        column.addWidget(self.button)
        column.addWidget(self.sentences)
        self._show()

    def show_items(self, items: Sequence[Item]) -> None:
        """Show those of the preflight among these."""
        item = next((item for item in items if item.check is Check.PREFLIGHT and item.parts), None)
        if (item and item.parts) != (self._item and self._item.parts):
            self._item = item
            self._show()

    def _show(self) -> None:
        parts = () if self._item is None else self._item.parts
        self.sentences.setText("\n".join(f"{sign_of(state)}  {sentence}" for state, sentence in parts))
        self.setVisible(bool(parts))
        self._suit(self.button.isChecked())

    def _suit(self, is_open: bool) -> None:
        self.button.setText(self.tr("Fewer sentences of the preflight") if is_open
                            else self.tr("All sentences of the preflight"))
        self.sentences.setVisible(is_open)
        self.toggled.emit()
