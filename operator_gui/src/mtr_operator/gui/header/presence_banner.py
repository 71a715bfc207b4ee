"""Asks the Operator to confirm to be present, without taking the focus from Stop."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtGui import QKeySequence
from PyQt5.QtWidgets import QHBoxLayout, QPushButton, QShortcut, QWidget

from ..fitting.prose import Prose
from ..theme.scale import S

# No letter: it is pressed while something else has the focus.
_KEY = "F9"


class PresenceBanner(QWidget):
    """Hidden while nothing is asked. Attributes: present: the button. Signals: confirmed."""

    confirmed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        question = Prose(self.tr("Are you present and in sight of the robot? Without an answer within a minute it "
                                 "stops and the test pauses."))
        question.setProperty("role", "banner")
        self.present = QPushButton(self.tr("I am present (F9)"))
        self.present.setProperty("role", "primary")
        # A key that is meant to stop the robot has to reach Stop.
        self.present.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.present.clicked.connect(self.confirmed)
        shortcut = QShortcut(QKeySequence(_KEY), self)
        shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)
        shortcut.setAutoRepeat(False)
        shortcut.activated.connect(self._confirm_by_key)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(S)
        layout.addWidget(question, 1)
        layout.addWidget(self.present)
        self.hide()

    def _confirm_by_key(self) -> None:
        if not self.isHidden():
            self.confirmed.emit()
