"""Pairing with the robot, once, by the code that it shows; and doing without encryption, by choice."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from PyQt5.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from ..links.pairing import Pairing
from ..sentences import translated
from ..theme.scale import XS, M, S
from .field import Field

_VIEWER = "viewer"


class PairingForm(QWidget):
    """Attributes: code: what the robot shows. button: Pair. said: how it ended. unencrypted: the choice."""

    def __init__(self, pairing: Pairing, host: Callable[[], str], parent: QWidget | None = None):
        """host: the robot's address as it is typed now."""
        super().__init__(parent)
        self._pairing, self._host = pairing, host
        self.code = Field(self.tr("Pairing code"), self.tr("once: the 6 digits that the robot shows for it"))
        self.button = QPushButton(self.tr("Pair"))
        self.said = QLabel()
        self.said.setWordWrap(True)
        self.said.setProperty("role", "notice")
        self.said.hide()
        self.unencrypted = QCheckBox(self.tr("Without encryption"))
        self.warning = QLabel(self.tr("Whoever is in the robot's network can read the link and move the robot. The "
                                      "robot has to allow it too."))
        self.warning.setWordWrap(True)
        self.warning.setProperty("role", "error")
        self.warning.hide()
        self._lay_out()
        self.button.clicked.connect(self._pair)
        self.code.edit.returnPressed.connect(self._pair)
        self.code.changed.connect(lambda: self.code.show_fault(""))
        self.unencrypted.toggled.connect(self.warning.setVisible)
        pairing.done.connect(self._show_done)
        pairing.refused.connect(self._show_refusal)

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.setSpacing(S)
        row.addWidget(self.code, 1)
        side = QVBoxLayout()
        side.addWidget(self.button)
        # As high as the label above the line, so that the button stands beside the line.
        side.insertSpacing(0, self.code.label.sizeHint().height() + XS)
        side.addStretch(1)
        row.addLayout(side)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        layout.addLayout(row)
        for widget in (self.said, self.unencrypted, self.warning):
            layout.addWidget(widget)

    def _pair(self) -> None:
        if not self.button.isEnabled():
            return
        # Not to the next button, which Enter would press.
        self.code.edit.setFocus()
        self.button.setEnabled(False)
        self.code.show_fault("")
        self._say(self.tr("Pairing with {host} ...").format(host=self._host()))
        self._pairing.begin(self._host(), self.code.text)

    def _show_done(self, role: str) -> None:
        self.button.setEnabled(True)
        self.code.edit.clear()
        self._say(self.tr("Paired: this laptop may look at the robot.") if role == _VIEWER else
                  self.tr("Paired: this laptop may control the robot."))

    def _show_refusal(self, text: str) -> None:
        self.button.setEnabled(True)
        self._say("")
        self.code.show_fault(translated(text))
        self.code.edit.setFocus()
        self.code.edit.selectAll()

    def _say(self, text: str) -> None:
        self.said.setText(text)
        self.said.setAccessibleName(text)
        self.said.setVisible(bool(text))
