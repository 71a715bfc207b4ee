"""A button that does something only when it is held: for what moves the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time

from PyQt5.QtCore import QEvent, QPoint, QRectF, Qt, QTimer, pyqtSignal
from PyQt5.QtGui import QColor, QFocusEvent, QHideEvent, QKeyEvent, QPainter, QPaintEvent
from PyQt5.QtWidgets import QPushButton, QToolTip, QWidget

_PAINT_MS = 30
# Of a tip: its frame, and the distance at which Qt puts it below a place.
_TIP_PX = 50
_BAR_PX = 6.0
_ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class HoldButton(QPushButton):
    """Held with the mouse, Space or Enter for HOLD_MS it says so once; let go before that it does nothing.

    A bar at its lower edge grows meanwhile.

    Signals: held: it was held long enough; by that the Operator confirms that the area is clear.
    """

    HOLD_MS = 1500
    held = pyqtSignal()

    def __init__(self, text: str, parent: QWidget | None = None):
        super().__init__(text, parent)
        self.setAutoDefault(False)
        hint = self.tr("Hold it for {time} s, with the mouse, Space or Enter: so you confirm that nobody and nothing "
                       "is in the robot's way.").format(time=f"{self.HOLD_MS / 1000.0:g}")
        self.setToolTip(hint)
        self.setAccessibleDescription(hint)
        self._begun_s: float | None = None
        self._end = QTimer(self)
        self._end.setSingleShot(True)
        self._end.timeout.connect(self._finish)
        self._paints = QTimer(self)
        self._paints.setInterval(_PAINT_MS)
        self._paints.timeout.connect(self.update)
        self.pressed.connect(self._begin)
        self.released.connect(self._let_go)

    def let_go(self) -> None:
        """What it was held for is over: it has to be held anew."""
        self._cancel()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """See QWidget; Enter is held as Space is."""
        if event.key() not in _ENTER:
            super().keyPressEvent(event)
        elif not event.isAutoRepeat():
            self.setDown(True)
            self.pressed.emit()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """See QWidget."""
        if event.key() not in _ENTER:
            super().keyReleaseEvent(event)
        elif not event.isAutoRepeat() and self.isDown():
            self.setDown(False)
            self.released.emit()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """See QWidget; who leaves it does not hold it."""
        self._cancel()
        super().focusOutEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        """See QWidget."""
        self._cancel()
        super().hideEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        """See QWidget; what stands against it meanwhile ends it."""
        if event.type() == QEvent.Type.EnabledChange and not self.isEnabled():
            self._cancel()
        super().changeEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """See QWidget."""
        super().paintEvent(event)
        if self._begun_s is None:
            return
        part = min((time.monotonic() - self._begun_s) * 1000.0 / self.HOLD_MS, 1.0)
        painter = QPainter(self)
        # The text's own colour: seen on every ground on which that is read.
        painter.fillRect(QRectF(0.0, self.height() - _BAR_PX, part * self.width(), _BAR_PX),
                         QColor(self.palette().buttonText().color()))

    def _begin(self) -> None:
        self._begun_s = time.monotonic()
        self._end.start(self.HOLD_MS)
        self._paints.start()

    def _let_go(self) -> None:
        if self._begun_s is not None:
            # At the lower edge of a screen a tip below would be moved over the button, and take the next press.
            above = QPoint(0, -self.fontMetrics().height() - _TIP_PX)
            QToolTip.showText(self.mapToGlobal(above), self.toolTip(), self)
        self._cancel()

    def _cancel(self) -> None:
        self._begun_s = None
        self._end.stop()
        self._paints.stop()
        self.setDown(False)
        self.update()

    def _finish(self) -> None:
        self._cancel()
        if self.isEnabled() and self.isVisible():
            self.held.emit()
