"""A large button with a sentence below its title."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QSize, Qt
from PyQt5.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from ..theme.scale import XS, L, M


class Tile(QPushButton):
    """The whole tile is clicked; its text is the title, for those who do not see it."""

    def __init__(self, title: str, sentence: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.title = title
        self.setProperty("role", "tile")
        self.setAccessibleName(title)
        self.setAccessibleDescription(sentence)
        heading, text = QLabel(title), QLabel(sentence)
        heading.setProperty("role", "large")
        text.setProperty("role", "soft")
        text.setWordWrap(True)
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(L, M, L, M)
        self._layout.setSpacing(XS)
        for label in (heading, text):
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            self._layout.addWidget(label)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return self._layout.sizeHint().expandedTo(QSize(320, 96))

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(240, 96)
