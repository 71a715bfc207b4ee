"""The connection window: address and ports of the robot, CAN adapter of the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses

from PyQt5.QtCore import QSize
from PyQt5.QtGui import QCloseEvent
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.station.connection import Connection, RobotChoice

from ..fitting.place import open_within
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.can_form import CanForm
from ..forms.language_box import LanguageBox
from ..forms.pairing_form import PairingForm
from ..forms.robot_form import RobotForm
from ..learn.offer import LearnOffer
from ..sentences import translated
from ..theme.scale import L, M, S
from .card import Card

_WIDTH = 960


class ConnectionWindow(QWidget):
    """Attributes: robot, pairing, can: the forms. button: Connect. message, detail: what went wrong.

    language: choice of it.
    """

    def __init__(self, flow: Flow, proposed: Connection, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        self.setWindowTitle(self.tr("Connect to the robot"))
        self._flow = flow
        self.robot = RobotForm()
        self.pairing = PairingForm(flow.connecting.pairing, lambda: self.robot.typed_host)
        self.can = CanForm()
        self.message, self.detail = QLabel(), QLabel()
        self.message.setProperty("role", "error")
        self.detail.setProperty("role", "hint")
        self.button = QPushButton(self.tr("Connect"))
        self.button.setProperty("role", "primary")
        self.button.setDefault(True)
        self.language = LanguageBox(flow.store.settings.language)
        self.language.currentIndexChanged.connect(self._change_language)
        self._lay_out()
        LearnOffer(flow, self.can, self)
        self.button.clicked.connect(self._connect)
        self.robot.submitted.connect(self._connect)
        self.can.submitted.connect(self._connect)
        self.pairing.unencrypted.toggled.connect(self._forget_refusal)
        for form in (self.robot, self.can):
            form.changed.connect(self._forget_refusal)
        self.can.changed.connect(self._suit_buses)
        flow.connecting.refused.connect(self._show_refusal)
        self.robot.show_choice(proposed.robot, flow.store.settings.hosts)
        self.can.show_choice(proposed.can)
        self.pairing.unencrypted.setChecked(proposed.robot.is_unencrypted)
        self._say(flow.store.problem, "")
        # The first in the order of Tab would be the language, which knows no Enter.
        self.robot.host.edit.setFocus()
        open_within(self, self.sizeHint().expandedTo(QSize(_WIDTH, 0)))

    def _lay_out(self) -> None:
        title = QLabel(self.tr("Connect"))
        title.setProperty("role", "title")
        cards = QHBoxLayout()
        cards.setSpacing(M)
        for heading, form in ((self.tr("Robot"), self.robot), (self.tr("Car"), self.can)):
            card = Card(heading)
            card.column.addWidget(form, 1)
            if form is self.robot:
                card.column.addWidget(self.pairing)
                card.column.addStretch(0)
            cards.addWidget(card, 1)
        notice = QVBoxLayout()
        notice.setSpacing(0)
        for label in (self.message, self.detail):
            label.setWordWrap(True)
            notice.addWidget(label)
        row = QHBoxLayout()
        row.setSpacing(M)
        row.addLayout(notice, 1)
        row.addWidget(self.button)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        top = QHBoxLayout()
        top.addWidget(title, 1)
        top.addWidget(self.language)
        layout.addLayout(top)
        layout.addWidget(Scroller(cards), 1)
        layout.addSpacing(S)
        layout.addLayout(row)

    def closeEvent(self, event: QCloseEvent) -> None:
        """See QWidget."""
        self._flow.close()
        super().closeEvent(event)

    @property
    def typed(self) -> Connection:
        """What stands in the fields; the last choice of a robot where that is none."""
        robot = self.robot.choice or self._flow.store.settings.connection.robot
        return Connection(self._as_chosen(robot), self.can.choice)

    def _as_chosen(self, robot: RobotChoice) -> RobotChoice:
        return dataclasses.replace(robot, is_unencrypted=self.pairing.unencrypted.isChecked())

    def _suit_buses(self) -> None:
        """Beside the adapters of many buses the pairing stays with the robot's address, instead of below them all."""
        column = self.pairing.parentWidget().layout()
        if isinstance(column, QVBoxLayout):
            has_further = bool(self.can.further.shown)
            column.setStretchFactor(self.robot, int(not has_further))
            column.setStretch(column.count() - 1, int(has_further))

    def _change_language(self) -> None:
        self._flow.use_language(self.language.currentData())

    def _connect(self) -> None:
        if not self.button.isEnabled():
            return
        robot = self.robot.choice
        if robot is None:
            self._say(self.tr("The IP address or port provided is invalid."), "")
            return
        self._say("", self.tr("Connecting to {host} ...").format(host=robot.host))
        self.button.setEnabled(False)
        self.language.setEnabled(False)
        self._flow.connecting.connect_to(Connection(self._as_chosen(robot), self.can.choice))

    def _show_refusal(self, part: str, text: str, bus: str = "") -> None:
        self.button.setEnabled(True)
        self.language.setEnabled(True)
        message = {
            "address": self.tr("The IP address or port provided is invalid."),
            "robot": self.tr("Connection failed, check the parameters."),
            "car": self.tr("The CAN adapter of the bus {bus} cannot be used.").format(bus=bus) if bus else
            self.tr("The CAN adapter cannot be used."),
        }[part]
        self._say(message, translated(text))
        if part == "car":
            self.can.show_fault(message, bus)

    def _forget_refusal(self) -> None:
        """What was wrong is being put right."""
        if self.button.isEnabled():
            self._say("", "")

    def _say(self, message: str, detail: str) -> None:
        self.message.setText(message)
        self.detail.setText(detail)
