"""A part of a window that scrolls up and down when there is no room for all of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QEvent, QObject, QSize, Qt
from PyQt5.QtWidgets import QFrame, QLayout, QScrollArea, QSizePolicy, QWidget

_LEAST_HEIGHT = 80


class Scroller(QScrollArea):
    """As wide as its content needs, and as high as it wants; no frame, and no scroll bar while all is seen."""

    def __init__(self, content: QWidget | QLayout, parent: QWidget | None = None):
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        # The content takes the focus, not its frame.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        if isinstance(content, QWidget):
            self.setWidget(content)
        else:
            content.setContentsMargins(0, 0, 0, 0)
            holder = QWidget()
            holder.setLayout(content)
            self.setWidget(holder)
        self.widget().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """See QObject; a content that grew wider makes the scroller so."""
        if event.type() == QEvent.Type.LayoutRequest:
            self.updateGeometry()
        return super().eventFilter(watched, event)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        hint = self.widget().sizeHint().expandedTo(self.widget().minimumSizeHint())
        return QSize(hint.width() + self._bar_width(), hint.height())

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        least = self.widget().minimumSizeHint()
        return QSize(least.width() + self._bar_width(), min(_LEAST_HEIGHT, least.height()))

    def _bar_width(self) -> int:
        return self.verticalScrollBar().sizeHint().width()
