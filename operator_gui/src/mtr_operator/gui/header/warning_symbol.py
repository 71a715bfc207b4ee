"""The warning triangle: there while the robot notifies of something, and pulsing when that is new."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

# The stubs of PyQt5 lack pyqtProperty.
from PyQt5.QtCore import (  # type: ignore[attr-defined]
    QEasingCurve,
    QPointF,
    QPropertyAnimation,
    QRectF,
    Qt,
    pyqtProperty,
)
from PyQt5.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PyQt5.QtWidgets import QAbstractButton, QWidget

from mtr_operator.domain.robot_status import Notification
from mtr_operator.station.readiness import ERROR, WARNING

from ..sentences import translated
from ..stopping import Stopping
from ..theme.appearance import Appearance
from .popup import Popup

# Fig. 4.2 and listing 4.4 of the thesis: from 1.0 to 1.2 within 200 ms.
PULSE_MS = 200
PULSE_SCALE = 1.2
_SIZE = 48
_TRIANGLE = ((25.0, 6.0), (47.0, 44.0), (3.0, 44.0))
_BOX = 50.0


class WarningSymbol(QAbstractButton):
    """Hidden without notifications; hovering and clicking lists them.

    Attributes:
        popup: the list. pulse: the animation.
    """

    def __init__(self, appearance: Appearance, stopping: Stopping, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._notifications: tuple[Notification, ...] = ()
        self._age_s: int | None = None
        self._scale = 1.0
        self.popup = Popup(self, stopping)
        self.pulse = QPropertyAnimation(self, b"scale", self)
        self.pulse.setDuration(PULSE_MS)
        self.pulse.setStartValue(1.0)
        self.pulse.setEndValue(PULSE_SCALE)
        self.pulse.setEasingCurve(QEasingCurve.Type.Linear)
        # No lambda: that would outlive the symbol, whose window may be closed while it pulses.
        self.pulse.finished.connect(self._rest)
        self.setAccessibleName(self.tr("Notifications of the robot"))
        self.setFixedSize(_SIZE, _SIZE)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.clicked.connect(self._open)
        appearance.changed.connect(self.update)
        self.hide()

    def show_notifications(self, notifications: Sequence[Notification], age_s: float | None = None) -> None:
        """Show these; a new one pulses. age_s: how long ago the robot said them, None while it does."""
        now = tuple(sorted(notifications, key=lambda notification: -notification.severity))
        age = None if age_s is None else round(age_s)
        if (now, age) == (self._notifications, self._age_s):
            return
        self._age_s = age
        known = {notification.code for notification in self._notifications}
        is_new = any(notification.code not in known for notification in now)
        self._notifications = now
        self.setVisible(bool(now))
        texts = [translated(notification.text) for notification in now]
        self.setToolTip("\n".join(texts if age is None else [self._heading(), *texts]))
        self.setAccessibleDescription(" ".join(texts))
        if is_new:
            self.pulse.start()
        if self.popup.isVisible():
            self._fill()
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        palette = self._appearance.palette
        worst = max((notification.severity for notification in self._notifications), default=WARNING)
        colour = palette.danger if worst >= ERROR else palette.warning if worst >= WARNING else palette.accent
        if self._age_s is not None:
            colour = palette.ink_soft
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(_SIZE / 2.0, _SIZE / 2.0)
        part = self._scale * _SIZE / _BOX / PULSE_SCALE
        painter.scale(part, part)
        painter.translate(-_BOX / 2.0, -_BOX / 2.0)
        if self.hasFocus():
            painter.setPen(QPen(QColor(palette.accent), 2))
            painter.drawRoundedRect(QRectF(-3, -3, _BOX + 6, _BOX + 6), 6, 6)
        painter.setPen(QPen(QColor(colour), 3, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap,
                            Qt.PenJoinStyle.RoundJoin))
        painter.setBrush(QColor(colour))
        painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in _TRIANGLE]))
        font = painter.font()
        font.setPixelSize(27)
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(QColor(palette.on_signal))
        painter.drawText(QRectF(0, 13, _BOX, 32), Qt.AlignmentFlag.AlignCenter, "!")

    def _open(self) -> None:
        self._fill()
        self.popup.open_below(self)

    def _fill(self) -> None:
        self.popup.fill(self._heading(),
                        [(translated(notification.text), "") for notification in self._notifications])

    def _heading(self) -> str:
        if self._age_s is None:
            return self.tr("The robot says")
        return self.tr("The robot said {age} s ago").format(age=self._age_s)

    def _rest(self) -> None:
        self._set_scale(1.0)

    def _get_scale(self) -> float:
        return self._scale

    def _set_scale(self, scale: float) -> None:
        self._scale = scale
        self.update()

    scale = pyqtProperty(float, _get_scale, _set_scale)
