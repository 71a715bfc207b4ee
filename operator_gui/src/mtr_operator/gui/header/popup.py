"""A list of sentences below a button of the header bar."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtWidgets import QFrame, QLabel, QVBoxLayout, QWidget

from ..stopping import Stopping
from ..theme.scale import M, S
from .stop_button import StopButton

_WIDTH = 460


class Popup(QFrame):
    """Closed by a click elsewhere or Escape, and while the robot may move by its Stop.

    Attributes: stop: there while the robot may move, for the list takes the clicks of all other windows.
    """

    def __init__(self, parent: QWidget, stopping: Stopping):
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("popup")
        self.stop = StopButton(stopping, self)
        self.stop.setVisible(stopping.may_move)
        self.stop.clicked.connect(self.hide)
        stopping.changed.connect(self._suit_motion)
        self._layout = QVBoxLayout()
        self._layout.setSpacing(S)
        column = QVBoxLayout(self)
        column.setContentsMargins(M, M, M, M)
        column.setSpacing(S)
        column.addLayout(self._layout)
        column.addWidget(self.stop)
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

    def _suit_motion(self, may_move: bool) -> None:
        self.stop.setVisible(may_move)
        self.adjustSize()

    def _add(self, text: str, role: str) -> None:
        label = QLabel(text)
        label.setWordWrap(True)
        label.setTextFormat(Qt.TextFormat.PlainText)
        label.setProperty("role", role)
        self._layout.addWidget(label)
