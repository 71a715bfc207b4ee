"""A list of sentences below a button of the header bar."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtWidgets import QFrame, QVBoxLayout, QWidget

from ..fitting.place import available
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..stopping import Stopping
from ..theme.scale import M, S
from .stop_button import StopButton

_WIDTH = 460
# Below it, so that it does not end at the screen's edge.
_MARGIN = 12


class Popup(QFrame):
    """Closed by a click elsewhere or Escape, and while the robot may move by its Stop.

    Attributes: stop: there while the robot may move, for the list takes the clicks of all other windows.
    """

    def __init__(self, parent: QWidget, stopping: Stopping):
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("popup")
        self._button: QWidget | None = None
        self.stop = StopButton(stopping, self)
        self.stop.setVisible(stopping.may_move)
        self.stop.clicked.connect(self.hide)
        stopping.changed.connect(self._suit_motion)
        self._layout = QVBoxLayout()
        self._layout.setSpacing(S)
        self._column = QVBoxLayout()
        self._column.setSpacing(M)
        self._column.addLayout(self._layout)
        self._column.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(M, M, M, M)
        column.setSpacing(S)
        column.addWidget(self.stop)
        column.addWidget(Scroller(self._column), 1)
        self._width = _WIDTH

    def fill(self, heading: str, entries: list[tuple[str, str]]) -> None:
        """Show a heading, and a sentence and an advice (or an empty text) per entry."""
        while self._layout.count():
            former = self._layout.takeAt(0).widget()
            former.hide()
            former.deleteLater()
        self._add(heading, "large")
        for sentence, advice in entries:
            self._add(sentence, "")
            if advice:
                self._add(advice, "soft")
        self.setAccessibleName(" ".join([heading, *(part for entry in entries for part in entry)]))

    def open_below(self, button: QWidget) -> None:
        """Show it below a button, within the button's window."""
        self._button = button
        self.fit()
        self.show()
        # Labels that wrap know their height only when they are shown.
        self.fit()

    def texts(self) -> list[str]:
        """What is shown."""
        return [self._layout.itemAt(index).widget().text() for index in range(self._layout.count())]

    def widen(self, width: int, content: QWidget) -> None:
        """Make room for more than a list of sentences, below them."""
        self._width = width
        self._column.insertWidget(1, content)

    def fit(self) -> None:
        """As high as its content, within the screen on which its button is."""
        button = self._button
        if button is None:
            return
        room = available(button)
        width = min(self._width, room.width() - 2 * _MARGIN)
        self.setFixedWidth(width)
        below = button.mapToGlobal(QPoint(button.width() - width, button.height() + S))
        left = max(min(below.x(), room.right() - width - _MARGIN), room.left() + _MARGIN)
        wanted = self._column.heightForWidth(width - 2 * M) if self._column.hasHeightForWidth() else 0
        wanted = max(wanted, self._column.sizeHint().height() if not self._column.hasHeightForWidth() else 0)
        chrome = 2 * M + (self.stop.sizeHint().height() + S if self.stop.isVisibleTo(self) else 0) + _MARGIN
        self.setFixedHeight(max(min(wanted + chrome, room.bottom() - below.y() - _MARGIN), 1))
        self.move(left, below.y())

    def _suit_motion(self, may_move: bool) -> None:
        self.stop.setVisible(may_move)
        self.fit()

    def _add(self, text: str, role: str) -> None:
        label = Prose(text)
        label.setTextFormat(Qt.TextFormat.PlainText)
        label.setProperty("role", role)
        self._layout.addWidget(label)
