"""A list of sentences below a button of the header bar."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtWidgets import QFrame, QLabel, QVBoxLayout, QWidget

from ..theme.scale import M, S

_WIDTH = 460


class Popup(QFrame):
    """Closed by a click elsewhere or Escape."""

    def __init__(self, parent: QWidget):
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("popup")
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(M, M, M, M)
        self._layout.setSpacing(S)
        self.setFixedWidth(_WIDTH)

    def fill(self, heading: str, entries: list[tuple[str, str]]) -> None:
        """Show a heading, and a sentence and an advice (or an empty text) per entry."""
        while self._layout.count():
            self._layout.takeAt(0).widget().deleteLater()
        self._add(heading, "large")
        for sentence, advice in entries:
            self._add(sentence, "")
            if advice:
                self._add(advice, "soft")
        self.setAccessibleName(" ".join([heading, *(part for entry in entries for part in entry)]))

    def open_below(self, button: QWidget) -> None:
        """Show it below a button, within the button's window."""
        self.adjustSize()
        corner = button.mapToGlobal(QPoint(button.width() - self.width(), button.height() + S))
        left = button.window().mapToGlobal(QPoint(S, 0)).x()
        self.move(max(corner.x(), left), corner.y())
        self.show()

    def texts(self) -> list[str]:
        """What is shown."""
        return [self._layout.itemAt(index).widget().text() for index in range(self._layout.count())]

    def _add(self, text: str, role: str) -> None:
        label = QLabel(text)
        label.setWordWrap(True)
        label.setTextFormat(Qt.TextFormat.PlainText)
        label.setProperty("role", role)
        self._layout.addWidget(label)
