"""The calibration window: what lift and buttons do, beside what they should do."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from PyQt5.QtCore import QSize, pyqtSignal
from PyQt5.QtWidgets import (
    QCheckBox,
    QDialog,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.domain.parameters import Declaration
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import PressReport
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.station.links.idle_loop import CalibrationRequest
from mtr_operator.station.readiness import ReadinessWord

from ..fitting.place import open_within
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.hold_release import HoldRelease
from ..forms.parameter_field import ParameterField
from ..i18n import number
from ..names import locks_text
from ..sentences import translated
from ..theme.scale import L, M, S
from ..theme.state import show_state
from .car_card import CarCard
from .card import Card

_WIDTH = 820
# Further rows of the sentences in the cards.
_WRAPPED_LINES = 4
_CM_PER_M = 100.0
_UNKNOWN = "\N{EN DASH}"


class CalibrationWindow(QDialog):
    """Attributes: key_height, strength, press_s: fields. buttons: check boxes by number. send: button.

    guide: button that opens the guided calibration.
    reported: labels by name of what they show. notice: what became of the request. car: check and mapping of the Car.
    hold: what holds the robot on its way.

    Signals: guide_wanted.
    """

    guide_wanted = pyqtSignal()

    def __init__(self, flow: Flow, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Calibration"))
        self._flow = flow
        self._sent: CalibrationRequest | None = None
        self._locks_before = LockState.UNKNOWN
        declared = KeyPressParameters.declarations()
        self.key_height = self._field("key_height_m", declared)
        self.strength = self._field("press_strength", declared)
        self.press_s = self._field("press_duration_s", declared)
        self.buttons = {1: QCheckBox(self.tr("Lock")), 2: QCheckBox(self.tr("Unlock"))}
        self.reported = {name: QLabel(_UNKNOWN) for name in ("height", "buttons", "locks")}
        self.car = CarCard(flow)
        self.hold = HoldRelease()
        self.hold.go_on.held.connect(flow.release_hold)
        self.notice = Prose()
        self.notice.setProperty("role", "soft")
        self.guide = QPushButton(self.tr("Guided calibration"))
        self.guide.setToolTip(self.tr("Press strength, key height and key's lever, kept with their date."))
        self.guide.clicked.connect(self.guide_wanted)
        self.send = QPushButton(self.tr("Send"))
        self.send.setProperty("role", "primary")
        self.send.clicked.connect(self._send)
        self._lay_out()
        for field in (self.key_height, self.strength, self.press_s):
            field.changed.connect(self._check)
        flow.bridge.changed.connect(self.show_model)
        self.show_model()
        open_within(self, self.wanted_size())

    @staticmethod
    def _field(name: str, declared: dict[str, Declaration]) -> ParameterField:
        field = ParameterField(name, declared[name])
        field.show_value(declared[name].default)
        return field

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.clicked.connect(self.reject)
        row = QHBoxLayout()
        row.addWidget(self.guide)
        row.addStretch(1)
        row.setSpacing(M)
        row.addWidget(close)
        row.addWidget(self.send)
        cards, right = QHBoxLayout(), QVBoxLayout()
        # Below each other, so that no button is out of sight on a small laptop.
        right.setSpacing(M)
        right.addWidget(self._reported_card(), 1)
        right.addWidget(self.car)
        cards.setSpacing(M)
        cards.addWidget(self._wanted_card(), 1)
        cards.addLayout(right, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        # Beside no card: it is seen without scrolling.
        layout.addWidget(self.hold.reason)
        layout.addWidget(self.hold.go_on)
        layout.addWidget(Scroller(cards), 1)
        layout.addLayout(row)
        self.send.setDefault(True)

    def _wanted_card(self) -> Card:
        card = Card(self.tr("Wanted"))
        for field in (self.key_height, self.strength, self.press_s):
            card.column.addWidget(field)
        card.column.addWidget(QLabel(self.tr("Buttons to press")))
        boxes = QHBoxLayout()
        boxes.setSpacing(L)
        for box in self.buttons.values():
            boxes.addWidget(box)
        boxes.addStretch(1)
        card.column.addLayout(boxes)
        card.column.addStretch(1)
        return card

    def _reported_card(self) -> Card:
        card = Card(self.tr("Reported by robot and Car"))
        titles = {"height": self.tr("Key height"), "buttons": self.tr("Buttons pressed"),
                  "locks": self.tr("The Car's locks")}
        rows = QGridLayout()
        rows.setSpacing(S)
        rows.setColumnStretch(1, 1)
        for row, (name, label) in enumerate(self.reported.items()):
            label.setProperty("role", "heading")
            label.setAccessibleName(titles[name])
            heading = QLabel(titles[name])
            heading.setProperty("role", "soft")
            rows.addWidget(heading, row, 0)
            rows.addWidget(label, row, 1)
        card.column.addLayout(rows)
        card.column.addWidget(self.notice)
        card.column.addStretch(1)
        return card

    def wanted_size(self) -> QSize:
        """Size at which all is seen, also what will be said of a press."""
        self.ensurePolished()
        size = self.sizeHint().expandedTo(QSize(_WIDTH, 0))
        # Qt guesses the height of texts that wrap before it knows their width.
        return QSize(size.width(), size.height() + _WRAPPED_LINES * self.fontMetrics().lineSpacing())

    def done(self, result: int) -> None:
        """See QDialog; however it is left, what moves is stopped first."""
        if self._flow.model.may_move:
            self._flow.stop()
        super().done(result)

    def show_model(self) -> None:
        """Show what the robot says now."""
        robot = self._flow.model.robot
        if robot is None:
            return
        status = robot.status
        height_m = status.key_height_m
        self.reported["height"].setText(_UNKNOWN if math.isnan(height_m) else f"{number(height_m * _CM_PER_M, 1)} cm")
        names = [self.buttons[button].text() if button in self.buttons else str(button)
                 for button in status.pressed_buttons]
        self.reported["buttons"].setText(", ".join(names) or self.tr("none"))
        for label in self.reported.values():
            show_state(label, "stale", self._flow.model.is_stale)
        self.reported["locks"].setText(locks_text(robot.lock_state))
        self._show_press(status.presses, robot.lock_state)
        model = self._flow.model
        is_linked = model.readiness.word is not ReadinessWord.LOST
        self.car.show_status(status, is_linked, model.may_move)
        self.hold.show_status(status, is_linked)
        self._check()

    def _show_press(self, presses: Sequence[PressReport], locks: LockState) -> None:
        sent = self._sent
        if sent is None or not sent.buttons or not presses:
            return
        newest = presses[-1]
        if newest.error:
            self.notice.setText(translated(newest.error))
            return
        pressed = self.tr("Pressed for {duration} s.").format(duration=number(newest.end_s - newest.start_s, 2))
        answer = self.tr("The Car has answered: {locks}.").format(locks=locks_text(locks)) \
            if locks not in (self._locks_before, LockState.UNKNOWN) else self.tr("The Car has not answered.")
        self.notice.setText(f"{pressed} {answer}")

    def _check(self) -> None:
        is_valid = all([field.check() for field in (self.key_height, self.strength, self.press_s)])
        self.send.setEnabled(is_valid and self._flow.model.readiness.word is not ReadinessWord.LOST)

    def _send(self) -> None:
        buttons = tuple(number for number, box in self.buttons.items() if box.isChecked())
        strength, press_s = self.strength.reading.value, self.press_s.reading.value
        if strength is None or press_s is None:
            return
        self._sent = CalibrationRequest(self.key_height.reading.value, buttons, strength, press_s)
        self._flow.calibrate(self._sent)
        robot = self._flow.model.robot
        self._locks_before = LockState.UNKNOWN if robot is None else robot.lock_state
        self.notice.setText(self.tr("Sent."))
