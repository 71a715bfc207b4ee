"""The key's lever, by rule and plumb line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.errors import InvalidCalibration
from mtr_operator.domain.estimation.budget.calibration_steps import lever_from, with_lever
from mtr_operator.domain.robot_status import RobotStatus

from ..forms.field import Field
from ..i18n import number, translate
from ..sentences import translated
from .step_card import StepCard, plus_minus_mm, readings_m

_CM_PER_M = 100.0


class LeverCard(StepCard):
    """Attributes: front, rear: readings to both axles."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(
            translate("Guide", "Key's lever"),
            translate("Guide", "Let a plumb line down from the key. Along the robot, read how far it hangs ahead of "
                               "the front axle's hub, and of the rear axle's; three times or more, with a new look at "
                               "each."), parent)
        hint = translate("Guide", "Readings with a blank between them; negative behind the axle.")
        self.front = Field(translate("Guide", "Key ahead of the front axle"), hint, "cm")
        self.rear = Field(translate("Guide", "Key ahead of the rear axle"), hint, "cm")
        self._stated_m: float | None = None
        for field in (self.front, self.rear):
            self.column.addWidget(field)
            field.changed.connect(self._judge)
        self.close_with()
        self._judge()

    def learn(self, status: RobotStatus) -> None:
        """The robot says where its key is."""
        if status.key_x != self._stated_m:
            self._stated_m = status.key_x
            self._judge()

    def _judge(self) -> None:
        fault = translate("Guide", "These are not numbers with a blank between them.")
        front_m, rear_m = readings_m(self.front, fault), readings_m(self.rear, fault)
        stated_m = self._stated_m
        if front_m is None or rear_m is None or stated_m is None or not (front_m or rear_m):
            self.show_result("", None)
            return
        try:
            found = lever_from(front_m, rear_m)
        except InvalidCalibration as error:
            self.show_result(translated(str(error)), None)
            return
        text = translate("Guide", "The key is {lever} cm ahead of the robot's middle ({sigma} mm, "
                                  "1 sigma); the robot computes with {stated} cm.").format(
            lever=number(found.mean_m * _CM_PER_M, 1), sigma=plus_minus_mm(found.sigma_m),
            stated=number(stated_m * _CM_PER_M, 1))
        advice = translate("Guide", "What lies between counts in full until the robot's description is put right.")
        is_off = abs(found.mean_m - stated_m) > 2.0 * found.sigma_m
        self.show_result(f"{text} {advice}" if is_off else text,
                         lambda record, signed: with_lever(record, found, stated_m, signed))
