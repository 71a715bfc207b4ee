"""The button that stops the robot: the same one in the header, in each dialog and in each list below the header."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QSize, Qt
from PyQt5.QtGui import QShowEvent
from PyQt5.QtWidgets import QBoxLayout, QDialog, QGridLayout, QPushButton, QWidget

from ..stopping import Stopping
from ..theme.state import show_state

_MIN_WIDTH = 112


class StopButton(QPushButton):
    """Always there and always to be pressed; full red, and with the focus, while the robot may move.

    It stops when it is pressed, not when it is let go.
    """

    def __init__(self, stopping: Stopping, parent: QWidget | None = None):
        super().__init__(parent)
        self.setText(self.tr("Stop"))
        self._stopping = stopping
        self.setAutoDefault(False)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setToolTip(self.tr("Stops the robot. While it may move, Space and Esc do so from everywhere."))
        self.setProperty("role", "stop")
        self._show(stopping.may_move)
        self.pressed.connect(stopping.stop)
        stopping.changed.connect(self._show)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return super().sizeHint().expandedTo(QSize(_MIN_WIDTH, 0))

    def showEvent(self, event: QShowEvent) -> None:
        """See QWidget."""
        super().showEvent(event)
        if self._stopping.may_move:
            self.setFocus()

    def _show(self, may_move: bool) -> None:
        show_state(self, "moving", may_move)
        if may_move and self.isVisible() and self.window().isActiveWindow():
            self.setFocus()


def add_stop(dialog: QDialog, stopping: Stopping) -> None:
    """Give a dialog a Stop of its own, on top where it is one of ours, below the rest where it is the toolkit's."""
    layout = dialog.layout()
    if dialog.findChild(StopButton) is not None:
        return
    stop = StopButton(stopping, dialog)
    if isinstance(layout, QGridLayout):
        layout.addWidget(stop, layout.rowCount(), 0, 1, -1)
    elif isinstance(layout, QBoxLayout):
        layout.insertWidget(0, stop, 0, Qt.AlignmentFlag.AlignLeft)
