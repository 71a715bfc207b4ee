"""Service mode: disable wheels, lift and servos for work on the robot, and release them again."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtWidgets import QLabel, QPushButton, QWidget

from mtr_operator.domain.robot_status import ServiceState

from ..dialogs import confirm
from ..fitting.prose import Prose
from ..flow import Flow
from ..forms.hold_button import HoldButton
from ..sentences import translated
from .card import Card


class ServiceCard(Card):
    """Attributes: state: what the robot reports. enter, release: buttons. hint: how it ends."""

    def __init__(self, flow: Flow, parent: QWidget | None = None):
        super().__init__(parent=parent)
        self.add_heading(self.tr("Service mode"))
        self._flow = flow
        self._agreement_id = 0
        self._is_asked = False
        self.state = Prose()
        self.enter = QPushButton(self.tr("Enter service mode"))
        self.enter.clicked.connect(self._ask)
        self.release = HoldButton(self.tr("Hold to release service mode"))
        self.release.held.connect(lambda: self._flow.leave_service(self._agreement_id))
        self.hint = QLabel(self.tr(
            "For work on mast, lift, servos or wheels. It remains active after restarts. It ends when it is released "
            "here and on the robot (rosrun mtr_dispatcher service_mode release) within a minute. It does not isolate "
            "energy: switch the robot off where you can."))
        self.hint.setWordWrap(True)
        self.hint.setProperty("role", "hint")
        for widget in (self.state, self.enter, self.release, self.hint):
            self.column.addWidget(widget)
        flow.bridge.changed.connect(self.show_model)
        self.show_model()

    def show_model(self) -> None:
        """Show the newest that the robot reports."""
        model = self._flow.model
        service = None if model.robot is None or model.is_stale else model.robot.status.service
        is_active = service is not None and service.is_active
        agreement_id = service.agreement_id if service is not None else 0
        if agreement_id != self._agreement_id:
            # Whoever holds the button has read another state.
            self.release.let_go()
            self._agreement_id = agreement_id
        self.state.setText(self._text(service))
        # Also to a robot that is silent: a Command may reach it all the same.
        self.enter.setVisible(not is_active)
        self.release.setVisible(is_active)
        self.release.setEnabled(service is not None and math.isnan(service.operator_agrees_s)
                                and not model.is_controlled_elsewhere)

    def _text(self, service: ServiceState | None) -> str:
        if service is None:
            return self.tr("The robot is silent, or its software is too old for service mode.")
        if not service.is_active:
            return self.tr("Not active.")
        robot, operator = service.robot_agrees_s, service.operator_agrees_s
        if not math.isnan(robot):
            return self.tr("Released on the robot: hold the button within {time} s.").format(time=f"{robot:.0f}")
        if not math.isnan(operator):
            return self.tr("Released here: release it on the robot within {time} s.").format(time=f"{operator:.0f}")
        return translated(service.text)

    def _ask(self) -> None:
        if self._is_asked:
            return
        question = self.tr("The robot stops, and its wheels, lift and servos are disabled, also after a restart, until "
                           "both sides release them. A test is paused. Enter service mode?")
        self._is_asked = True
        try:
            if confirm(self, self.window().windowTitle(), question, (self.tr("Enter service mode"),
                                                                     self.tr("Cancel"))):
                self._flow.enter_service()
        finally:
            self._is_asked = False
