"""Symbols of the header bar, painted so that they follow theme and screen resolution: battery, lock, cogwheel."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtCore import QPointF, QRectF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPainterPath, QPaintEvent, QPen
from PyQt5.QtWidgets import QSizePolicy, QToolButton, QWidget

from mtr_operator.station.readiness import EMPTY_BATTERY_PERCENT, LOW_BATTERY_PERCENT

from ..theme.appearance import Appearance

_SIZE = 34
_TEETH = 8
# Of the battery.
_TEXT_LEFT = 44


class BatterySymbol(QWidget):
    """Charge of the robot's battery, as a picture and in percent."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._percent: int | None = None
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        appearance.changed.connect(self.update)
        self.show_percent(None)

    def sizeHint(self) -> QSize:
        """See QWidget; the charge never moves what stands beside it."""
        return QSize(_TEXT_LEFT + self.fontMetrics().horizontalAdvance("100 %") + 2, _SIZE)

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return self.sizeHint()

    def show_percent(self, percent: int | None) -> None:
        """Show a charge; None is an unknown one."""
        self._percent = percent
        text = self.tr("Battery of the robot: unknown") if percent is None else \
            self.tr("Battery of the robot: {percent} %").format(percent=percent)
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        palette, percent = self._appearance.palette, self._percent
        body = QRectF(2, 8, 34, 18)
        painter.setPen(QPen(QColor(palette.ink), 2))
        painter.drawRoundedRect(body, 3, 3)
        painter.fillRect(QRectF(37, 13, 3, 8), QColor(palette.ink))
        if percent is not None:
            colour = palette.danger if percent < EMPTY_BATTERY_PERCENT else \
                palette.warning if percent < LOW_BATTERY_PERCENT else palette.ok
            painter.fillRect(QRectF(5, 11, 28 * min(percent, 100) / 100.0, 12), QColor(colour))
        text = "\N{EN DASH}" if percent is None else f"{percent} %"
        room = QRectF(_TEXT_LEFT, 0, self.width() - _TEXT_LEFT, _SIZE)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)


class LockSymbol(QWidget):
    """A padlock, closed when the link to the robot is encrypted."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._is_closed = True
        self.setFixedSize(_SIZE, _SIZE)
        appearance.changed.connect(self.update)
        self.show_closed(False)

    def show_closed(self, is_closed: bool) -> None:
        """Show whether the link is encrypted."""
        if is_closed == self._is_closed:
            return
        self._is_closed = is_closed
        text = self.tr("The link to the robot is encrypted.") if is_closed else \
            self.tr("The link to the robot is not encrypted.")
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour = QColor(self._appearance.palette.ok if self._is_closed else self._appearance.palette.ink_soft)
        painter.setPen(QPen(colour, 3))
        shackle = QRectF(11, 6, 12, 18)
        if not self._is_closed:
            shackle.translate(7, 0)
        painter.drawArc(shackle, 0, 180 * 16)
        painter.drawLine(shackle.topLeft() + QPointF(0, 9), shackle.topLeft() + QPointF(0, 11))
        painter.setBrush(colour)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.drawRoundedRect(QRectF(7, 15, 20, 14), 3, 3)


class CogwheelButton(QToolButton):
    """Opens the settings window."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self.setFixedSize(44, 44)
        self.setAccessibleName(self.tr("Settings"))
        self.setToolTip(self.tr("Settings"))
        appearance.changed.connect(self.update)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(44, 44)

    def paintEvent(self, event: QPaintEvent) -> None:
        """See QWidget."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(self.width() / 2.0, self.height() / 2.0)
        painter.fillPath(_cogwheel(), QColor(self._appearance.palette.ink))


def _cogwheel() -> QPainterPath:
    path = QPainterPath()
    corners = []
    for tooth in range(_TEETH):
        middle = 2.0 * math.pi * tooth / _TEETH
        corners += [(10.0, middle - 0.28), (14.0, middle - 0.18), (14.0, middle + 0.18), (10.0, middle + 0.28)]
    points = [QPointF(radius * math.cos(angle), radius * math.sin(angle)) for radius, angle in corners]
    path.moveTo(points[0])
    for point in points[1:]:
        path.lineTo(point)
    path.closeSubpath()
    path.addEllipse(QPointF(0.0, 0.0), 4.5, 4.5)
    return path
