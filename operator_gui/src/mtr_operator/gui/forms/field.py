"""A labelled line to type in, with a hint that gives way to a sentence when what was typed is wrong."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from ..theme.scale import XS, S
from ..theme.state import show_state
from .buddy_label import BuddyLabel

_UNIT_WIDTH = 56


class Field(QWidget):
    """A click on the label focuses the line.

    Attributes:
        edit: the line. label: its label. note: hint or fault below it.
    Signals:
        changed: the text is another one.
    """

    changed = pyqtSignal()

    def __init__(self, title: str, hint: str = "", unit: str | None = None, parent: QWidget | None = None):
        super().__init__(parent)
        self._hint = hint
        self.edit = QLineEdit()
        self.label = BuddyLabel(title, self.edit)
        self.note = QLabel(hint)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "hint")
        self.edit.setAccessibleName(f"{title}, {unit}" if unit else title)
        self.edit.setAccessibleDescription(hint)
        self.edit.textChanged.connect(self.changed)
        row = QHBoxLayout()
        row.setSpacing(S)
        row.addWidget(self.edit, 1)
        if unit is not None:
            unit_label = QLabel(unit)
            unit_label.setFixedWidth(_UNIT_WIDTH)
            row.addWidget(unit_label)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(XS)
        layout.addWidget(self.label)
        layout.addLayout(row)
        layout.addWidget(self.note)
        self.note.setVisible(bool(hint))

    @property
    def text(self) -> str:
        """What was typed."""
        return self.edit.text()

    def show_text(self, text: str) -> None:
        """Show another text."""
        self.edit.setText(text)

    @property
    def fault(self) -> str:
        """The sentence that is shown; empty when the hint is."""
        return self.note.text() if self.note.property("role") == "error" else ""

    def mark(self, is_faulty: bool) -> None:
        """Frame the line as wrong although its own text is right: it does not go with another one."""
        show_state(self.edit, "faulty", is_faulty or bool(self.fault))

    def show_fault(self, sentence: str) -> None:
        """Say what is wrong; empty shows the hint again."""
        if sentence == self.fault:
            return
        self.note.setText(sentence or self._hint)
        self.note.setVisible(bool(sentence or self._hint))
        self.edit.setAccessibleDescription(sentence or self._hint)
        show_state(self.note, "role", "error" if sentence else "hint")
        show_state(self.edit, "faulty", bool(sentence))
