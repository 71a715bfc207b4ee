"""Symbols of the header bar, painted so that they follow theme and resolution: battery, locks, link, cogwheel."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtCore import QPointF, QRectF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPainterPath, QPaintEvent, QPen
from PyQt5.QtWidgets import QSizePolicy, QToolButton, QWidget

from mtr_operator.domain.battery.levels import is_critical, is_low
from mtr_operator.domain.ports import LockState

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
        self._is_stale = False
        self._told = ""
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        appearance.changed.connect(self.update)
        self.show_percent(None)

    def sizeHint(self) -> QSize:
        """See QWidget; the charge never moves what stands beside it."""
        return QSize(_TEXT_LEFT + self.fontMetrics().horizontalAdvance("100 %") + 2, _SIZE)

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return self.sizeHint()

    def show_percent(self, percent: int | None, age_s: float | None = None) -> None:
        """Show a charge; None is an unknown one. age_s: how old it is, None while it is of now."""
        self._percent, self._is_stale = percent, age_s is not None
        text = self.tr("Battery of the robot: unknown") if percent is None else \
            self.tr("Battery of the robot: {percent} %").format(percent=percent)
        if age_s is not None:
            text += " " + self.tr("({age} s ago)").format(age=f"{age_s:.0f}")
        if text == self._told:
            return
        self._told = text
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        palette, percent = self._appearance.palette, self._percent
        body = QRectF(2, 8, 34, 18)
        ink = QColor(palette.ink_soft if self._is_stale else palette.ink)
        painter.setPen(QPen(ink, 2))
        painter.drawRoundedRect(body, 3, 3)
        painter.fillRect(QRectF(37, 13, 3, 8), ink)
        if percent is not None:
            colour = palette.line if self._is_stale else palette.danger if is_critical(percent) else \
                palette.warning if is_low(percent) else palette.ok
            painter.fillRect(QRectF(5, 11, 28 * min(percent, 100) / 100.0, 12), QColor(colour))
        text = "\N{EN DASH}" if percent is None else f"{percent} %"
        room = QRectF(_TEXT_LEFT, 0, self.width() - _TEXT_LEFT, _SIZE)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)


class LocksSymbol(QToolButton):
    """A padlock that is as the Car's locks are: closed, open, or dashed when nobody knows; opens the bus view."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._shown: tuple[LockState, bool] | None = None
        self.setFixedSize(_SIZE, _SIZE)
        appearance.changed.connect(self.update)
        self.show_locks(LockState.UNKNOWN, False)

    def show_locks(self, locks: LockState, is_stale: bool) -> None:
        """Show the state of the locks; a stale one is not known any more."""
        shown = (LockState.UNKNOWN if is_stale else locks, is_stale)
        if shown == self._shown:
            return
        self._shown = shown
        state = {LockState.LOCKED: self.tr("The Car is locked."), LockState.UNLOCKED: self.tr("The Car is unlocked."),
                 LockState.UNKNOWN: self.tr("Whether the Car is locked is not known.")}[shown[0]]
        self.setAccessibleName(state)
        self.setAccessibleDescription(self.tr("A click opens the live bus view."))
        self.setToolTip(f"{state} {self.accessibleDescription()}")
        self.update()

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(_SIZE, _SIZE)

    def paintEvent(self, event: QPaintEvent) -> None:
        """See QWidget."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        locks = self._shown[0] if self._shown else LockState.UNKNOWN
        is_known = locks is not LockState.UNKNOWN
        colour = QColor(self._appearance.palette.ink if is_known else self._appearance.palette.ink_soft)
        painter.setPen(QPen(colour, 3 if is_known else 2, Qt.PenStyle.SolidLine if is_known else Qt.PenStyle.DotLine))
        shackle = QRectF(8, 5, 12, 18)
        if locks is LockState.UNLOCKED:
            shackle.translate(9, 0)
        painter.drawArc(shackle, 0, 180 * 16)
        painter.drawLine(shackle.topLeft() + QPointF(0, 9), shackle.topLeft() + QPointF(0, 11))
        if is_known:
            painter.setBrush(colour)
            painter.setPen(Qt.PenStyle.NoPen)
        painter.drawRoundedRect(QRectF(4, 15, 20, 14), 3, 3)


class LinkSymbol(QWidget):
    """A shield: with a tick on an encrypted link, hollow and crossed out on one that is not: grey within this computer,
    red where anybody in the network can read and send."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._is_secret, self._is_exposed = True, False
        self.setFixedSize(_SIZE, _SIZE)
        appearance.changed.connect(self.update)
        self.show_secret(False)

    def show_secret(self, is_secret: bool, is_exposed: bool = False) -> None:
        """Show whether the link is encrypted, and whether others can reach it."""
        if (is_secret, is_exposed) == (self._is_secret, self._is_exposed):
            return
        self._is_secret, self._is_exposed = is_secret, is_exposed
        text = self.tr("The link to the robot is encrypted.") if is_secret else \
            self.tr("The link is not encrypted: whoever is in its network can move the robot.") if is_exposed else \
            self.tr("The link to the robot is not encrypted.")
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        palette = self._appearance.palette
        colour = palette.ok if self._is_secret else palette.danger if self._is_exposed else palette.ink_soft
        painter.setPen(QPen(QColor(colour), 2.5))
        painter.drawPath(_shield())
        lines = ((QPointF(11, 16), QPointF(15, 20)), (QPointF(15, 20), QPointF(22, 11))) if self._is_secret else \
            ((QPointF(5, 29), QPointF(29, 5)),)
        for start, end in lines:
            painter.drawLine(start, end)


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


def _shield() -> QPainterPath:
    path = QPainterPath(QPointF(17, 4))
    path.lineTo(28, 8)
    path.lineTo(28, 17)
    path.quadTo(28, 26, 17, 31)
    path.quadTo(6, 26, 6, 17)
    path.lineTo(6, 8)
    path.closeSubpath()
    return path


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
