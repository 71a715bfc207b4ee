"""Where a window opens: inside the part of the screen that is free for windows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPoint, QRect, QSize
from PyQt5.QtGui import QGuiApplication
from PyQt5.QtWidgets import QWidget

# A window manager's title bar and borders; Qt knows them only when the window is shown.
_FRAME = QSize(16, 40)
# The smallest screen that is served: 1280x720 at a scale of 1.5, in pixels of the scale.
SMALLEST = QSize(853, 480)


def available(window: QWidget) -> QRect:
    """What is free on the screen on which the window, or its parent, is or opens."""
    owner = window.parentWidget() or window
    screen = owner.window().windowHandle().screen() if owner.window().windowHandle() else None
    return (screen or QGuiApplication.primaryScreen()).availableGeometry()


def open_within(window: QWidget, wanted: QSize) -> None:
    """Give a window that is not shown yet the size wanted, or what the screen has room for, in the room's middle."""
    room = available(window)
    most = (room.size() - _FRAME).expandedTo(QSize(1, 1))
    size = wanted.boundedTo(most)
    window.setMinimumSize((SMALLEST - _FRAME).boundedTo(size))
    window.resize(size)
    framed = size + _FRAME
    window.move(room.topLeft() + QPoint((room.width() - framed.width()) // 2, (room.height() - framed.height()) // 2))
