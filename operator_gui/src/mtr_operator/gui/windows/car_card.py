"""The Car between two tests: have the robot check where it stands, or map it again."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QLabel, QVBoxLayout, QWidget

from mtr_operator.domain.robot_status import CheckState, Mode, RobotStatus
from mtr_operator.station.links.idle_loop import CarRequest
from mtr_operator.station.motion import ROUNDS

from ..fitting.prose import Prose
from ..flow import Flow
from ..forms.hold_button import HoldButton
from ..i18n import number
from ..sentences import translated
from ..theme.scale import S
from .card import Card


class CarCard(Card):
    """Attributes: check, map: buttons. notice: what the robot says of the Car."""

    def __init__(self, flow: Flow, parent: QWidget | None = None):
        super().__init__(parent=parent)
        self.add_heading(self.tr("Car"))
        self._flow = flow
        self.notice = Prose()
        self.check = self._button(self.tr("Hold to check its position"), CarRequest.CHECK)
        self.map = self._button(self.tr("Hold to map it again"), CarRequest.MAP)
        hint = QLabel(self.tr("The robot drives around the Car for both: hold the button when its way is clear."))
        hint.setWordWrap(True)
        hint.setProperty("role", "hint")
        buttons = QVBoxLayout()
        buttons.setSpacing(S)
        for button in (self.check, self.map):
            buttons.addWidget(button)
        self.column.addWidget(self.notice)
        self.column.addLayout(buttons)
        self.column.addWidget(hint)

    def _button(self, text: str, request: CarRequest) -> HoldButton:
        button = HoldButton(text)
        button.held.connect(lambda: self._flow.request_car(request))
        return button

    def show_status(self, status: RobotStatus, is_linked: bool, is_moving: bool) -> None:
        """Show what the robot says; is_linked: it takes requests. is_moving: it may move."""
        self.check.setEnabled(is_linked and status.car is not None and status.car_check is not None and not is_moving)
        self.map.setEnabled(is_linked and not is_moving)
        self.map.setText(self.tr("Hold to map it") if status.car is None else self.tr("Hold to map it again"))
        self.notice.setText(self._text(status, is_moving))

    def _text(self, status: RobotStatus, is_moving: bool) -> str:
        if status.mode in ROUNDS and not is_moving:
            return self.tr("The robot was stopped on its way around the Car.")
        if status.mode is Mode.MAPPING_CAR:
            return self.tr("The robot maps the Car.")
        if status.mode is Mode.CHECKING_CAR:
            return self.tr("The robot checks where the Car stands.")
        check, car = status.car_check, status.car
        if check is not None and check.state in (CheckState.PASSED, CheckState.FAILED) and check.message:
            return translated(check.message)
        if car is None:
            return self.tr("The Car is not measured yet.")
        return self.tr("The Car measures {length} m by {width} m.").format(
            length=number(car.length, 2), width=number(car.width, 2))
