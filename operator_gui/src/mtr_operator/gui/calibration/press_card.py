"""The strength of a press, found by the Car's own answer."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QPushButton, QWidget

from mtr_operator.domain.estimation.budget.calibration_steps import with_press
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.station.calibration.press_search import IN_A_ROW, STEP, PressEnd, PressSearch

from ..i18n import number, translate
from ..sentences import translated
from .step_card import StepCard


class PressCard(StepCard):
    """Attributes: begin: button that begins the search.

    Signals: press_wanted(request).
    """

    press_wanted = pyqtSignal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(
            translate("Guide", "Press strength"),
            translate("Guide", "Have the robot stand where the Car hears its key well. The key's buttons are pressed, "
                               "weakly first, until the Car answers {count} times in a row.").format(count=IN_A_ROW),
            parent)
        self.begin = QPushButton(translate("Guide", "Find the strength"))
        self.begin.clicked.connect(self._begin)
        self._search: PressSearch | None = None
        self.close_with(self.begin)

    def learn(self, status: RobotStatus, locks: LockState, may_order: bool) -> None:
        """A Status with the Car's locks at its time. may_order: the robot takes orders now."""
        search = self._search
        self.begin.setEnabled(may_order and (search is None or search.end is not None))
        if search is None or search.end is not None:
            return
        request = search.learn(status, locks)
        if request is not None:
            self.press_wanted.emit(request)
        self._tell(search)

    def stop(self) -> None:
        """The robot was stopped, or another order was given."""
        if self._search is not None and self._search.end is None:
            self._search.stop()
            self._tell(self._search)

    def _begin(self) -> None:
        self._search = PressSearch(KeyPressParameters().press_duration_s)
        self.begin.setEnabled(False)
        self._tell(self._search)

    def _tell(self, search: PressSearch) -> None:
        if search.end is PressEnd.FOUND:
            text = translate("Guide", "The Car answers each time from a strength of {strength} on ({presses} presses).")
            strength, presses = search.strength, search.presses
            self.show_result(text.format(strength=number(strength, 2), presses=presses),
                             lambda record, signed: with_press(record, strength, STEP, presses, signed))
            return
        self.show_result({
            None: translate("Guide", "Press {presses}, with a strength of {strength}."),
            PressEnd.NO_ANSWER: translate("Guide", "The Car does not answer even to full strength: go nearer, and "
                                                   "check the key's battery and its seat."),
            PressEnd.LOCKS_UNKNOWN: translate("Guide", "Whether the Car is locked is not known; choose its CAN adapter "
                                                       "under Settings, and wake the Car."),
            PressEnd.NOT_PRESSED: translate("Guide", "The robot does not say that it has pressed; see its "
                                                     "notifications."),
            PressEnd.REFUSED: translated(search.error),
            PressEnd.STOPPED: translate("Guide", "Stopped.")}[search.end].format(
                presses=search.presses, strength=number(search.strength, 2)), None)
