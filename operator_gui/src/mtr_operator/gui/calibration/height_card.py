"""The key's height, against a tape measure."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QPushButton, QWidget

from mtr_operator.domain.errors import InvalidCalibration
from mtr_operator.domain.estimation.budget.calibration_steps import MIN_READINGS, height_from, with_height
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

from ..forms.field import Field
from ..forms.parameter_field import ParameterField
from ..i18n import number, translate
from ..sentences import translated
from .step_card import StepCard, plus_minus_mm, readings_m

_CM_PER_M, _MM_PER_M = 100.0, 1000.0
# Between two Statuses a lift at rest reports the same height, but for noise.
_REST_M = 0.0005


class HeightCard(StepCard):
    """Attributes: wanted: height to go to. go: button. tape: what the tape measure says. take: button. forget: button.
    readings: tape and reported height of each, in m.

    Signals: height_wanted(m).
    """

    height_wanted = pyqtSignal(float)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(
            translate("Guide", "Key height"),
            translate("Guide", "Send the key to a height, measure from the floor to its middle, and take the reading; "
                               "at three heights or more, low ones and high ones."), parent)
        declared = KeyPressParameters.declarations()["key_height_m"]
        self.wanted = ParameterField("key_height_m", declared)
        self.wanted.show_value(declared.default)
        self.go = QPushButton(translate("Guide", "Send the key there"))
        self.tape = Field(translate("Guide", "Tape measure"), "", "cm")
        self.take = QPushButton(translate("Guide", "Take the reading"))
        self.forget = QPushButton(translate("Guide", "Forget the readings"))
        self.readings: list[tuple[float, float]] = []
        self._reported_m, self._is_at_rest, self._may_order = math.nan, False, False
        self.column.addWidget(self.wanted)
        self.column.addWidget(self.go, 0, Qt.AlignmentFlag.AlignLeft)
        self.column.addWidget(self.tape)
        self.close_with(self.take, self.forget)
        self.go.clicked.connect(self._go)
        self.take.clicked.connect(self._take)
        self.forget.clicked.connect(self._forget)
        for field in (self.wanted, self.tape):
            field.changed.connect(self._suit)
        self._judge()

    def learn(self, status: RobotStatus, may_order: bool) -> None:
        """The robot says how high its key is. may_order: it takes orders now."""
        self._is_at_rest = abs(status.key_height_m - self._reported_m) < _REST_M
        self._reported_m, self._may_order = status.key_height_m, may_order
        self._suit()

    def _suit(self) -> None:
        self.go.setEnabled(self.wanted.check() and self._may_order)
        readings = readings_m(self.tape, translate("Guide", "This is not a number."))
        self.take.setEnabled(readings is not None and len(readings) == 1 and self._is_at_rest)
        self.forget.setEnabled(bool(self.readings))

    def _go(self) -> None:
        self.height_wanted.emit(self.wanted.reading.value)

    def _take(self) -> None:
        readings = readings_m(self.tape, "")
        if readings:
            self.readings.append((readings[0], self._reported_m))
            self.tape.show_text("")
            self._judge()

    def _forget(self) -> None:
        self.readings.clear()
        self._judge()

    def _judge(self) -> None:
        self._suit()
        taken = ", ".join(translate("Guide", "{tape} cm for {reported} cm").format(
            tape=number(tape_m * _CM_PER_M, 1), reported=number(reported_m * _CM_PER_M, 1))
            for tape_m, reported_m in self.readings)
        lines = [translate("Guide", "Readings: {taken}.").format(taken=taken)] if taken else []
        if len(self.readings) < MIN_READINGS:
            self.show_result(" ".join(lines), None)
            return
        try:
            found = height_from(self.readings)
        except InvalidCalibration as error:
            self.show_result(" ".join([*lines, translated(str(error))]), None)
            return
        lines.append(translate("Guide", "The key is {offset} mm higher than the robot reports ({sigma} "
                                        "mm, 1 sigma).").format(
            offset=number(found.mean_m * _MM_PER_M, 1), sigma=plus_minus_mm(found.sigma_m)))
        self.show_result(" ".join(lines), lambda record, signed: with_height(record, found, signed))
