"""A labelled text of several lines, with a hint that gives way to a sentence when what was typed is wrong."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QLabel, QPlainTextEdit, QVBoxLayout, QWidget

from ..theme.scale import XS
from ..theme.state import show_state
from .buddy_label import BuddyLabel

_ROWS = 3


class TextArea(QWidget):
    """Attributes: edit: the text. label: its label. note: hint or fault below it.

    Signals: changed: the text is another one.
    """

    changed = pyqtSignal()

    def __init__(self, title: str, hint: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self._hint = hint
        self.edit = QPlainTextEdit()
        # Tab goes on to the next field.
        self.edit.setTabChangesFocus(True)
        self.edit.setFixedHeight(_ROWS * self.edit.fontMetrics().lineSpacing() + 24)
        self.edit.setAccessibleName(title)
        self.edit.setAccessibleDescription(hint)
        self.edit.textChanged.connect(self.changed)
        self.label = BuddyLabel(title, self.edit)
        self.note = QLabel(hint)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "hint")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(XS)
        for widget in (self.label, self.edit, self.note):
            layout.addWidget(widget)

    @property
    def text(self) -> str:
        """What was typed."""
        return self.edit.toPlainText()

    def show_text(self, text: str) -> None:
        """Show another text."""
        self.edit.setPlainText(text)

    def show_fault(self, sentence: str) -> None:
        """Say what is wrong; empty shows the hint again."""
        self.note.setText(sentence or self._hint)
        self.note.setVisible(bool(sentence or self._hint))
        show_state(self.note, "role", "error" if sentence else "hint")
        show_state(self.edit, "faulty", bool(sentence))
