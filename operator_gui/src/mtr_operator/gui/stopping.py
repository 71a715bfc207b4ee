"""The one way from the window to a stop of the robot: from every button, key and window that closes."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from typing import Iterator

from PyQt5.QtCore import QEvent, QObject, Qt, pyqtSignal
from PyQt5.QtGui import QKeyEvent
from PyQt5.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QDialog,
    QLineEdit,
    QPlainTextEdit,
    QTextEdit,
    QWidget,
)

from .flow import Flow
from .forms.hold_button import HoldButton

_STOP_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_Escape)
_PRESS_KEYS = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
# Names that are looked up at each event of the application.
_KEY, _OPENS = QEvent.Type.KeyPress, (QEvent.Type.Polish, QEvent.Type.Show)


class Stopping(QObject):
    """Knows whether the robot may move, and takes the keys of all windows from install() to remove().

    While it may move Space and Escape stop it, wherever the focus is; in a text field Space is typed, and Escape leaves
    the field. Enter presses the button that has the focus, which in windows that are no dialogs Qt does not do.

    Attributes: may_move: as told last.
    Signals: changed(may_move): it may move now, or stands. dialog_opens(dialog): so that each one, those of the toolkit
        too, can be given a Stop; may come more than once.
    """

    changed = pyqtSignal(bool)
    dialog_opens = pyqtSignal(object)

    def __init__(self, flow: Flow):
        super().__init__()
        self._flow = flow
        self.may_move = False
        self._is_installed = False
        flow.bridge.changed.connect(self._learn)

    def install(self) -> None:
        """Begin to take keys."""
        self._is_installed = True
        QApplication.instance().installEventFilter(self)

    def remove(self) -> None:
        """End; safe to call twice."""
        self._is_installed = False
        QApplication.instance().removeEventFilter(self)

    @contextlib.contextmanager
    def building(self) -> Iterator[None]:
        """Build widgets without looking at each of their events, of which a window causes 10,000.

        No key is lost: Qt delivers keys from an event loop only. So nothing within may run one, or make a dialog, which
        gets its Stop when it is polished.
        """
        was_installed = self._is_installed
        self.remove()
        try:
            yield
        finally:
            if was_installed:
                self.install()

    def stop(self) -> None:
        """Stop the robot; the stop has left when this returns."""
        self._flow.stop()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """See QObject."""
        kind = event.type()
        if kind == _KEY:
            return isinstance(event, QKeyEvent) and self._takes(event)
        # Polish is before its size is chosen; a dialog may be polished before it is made.
        if kind in _OPENS and isinstance(watched, QDialog):
            self.dialog_opens.emit(watched)
        return False

    def _takes(self, event: QKeyEvent) -> bool:
        focus = QApplication.focusWidget()
        if event.isAutoRepeat() and event.key() in (*_STOP_KEYS, *_PRESS_KEYS) and self._flow.model.may_move:
            # Whoever holds a key to start has not let it go yet: only a new press stops.
            return not _is_text_field(focus)
        if event.key() in _STOP_KEYS and self._flow.model.may_move:
            if not _is_text_field(focus):
                self.stop()
                return True
            if event.key() == Qt.Key.Key_Escape and focus is not None:
                focus.clearFocus()
                return True
        presses = event.key() in _PRESS_KEYS and isinstance(focus, QAbstractButton) and focus.isEnabled()
        if presses and not isinstance(focus.window(), QDialog) and not isinstance(focus, HoldButton):
            focus.click()
            return True
        return False

    def _learn(self) -> None:
        may_move = self._flow.model.may_move
        if may_move != self.may_move:
            self.may_move = may_move
            self.changed.emit(may_move)


def _is_text_field(widget: QWidget | None) -> bool:
    return isinstance(widget, (QLineEdit, QTextEdit, QPlainTextEdit, QAbstractSpinBox)) and not widget.isReadOnly()
