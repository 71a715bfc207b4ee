"""Why the robot is held, and the button that has it go on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QCoreApplication

from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.station.readiness import HELD_CODE

from ..fitting.prose import Prose
from ..sentences import translated
from .hold_button import HoldButton


class HoldRelease:
    """Two widgets, which each screen lays out as it likes.

    Attributes: reason: why it stands. go_on: held by the Operator who has looked at the cause.
    """

    def __init__(self) -> None:
        self.reason = Prose()
        self.reason.setProperty("role", "banner")
        self.go_on = HoldButton(QCoreApplication.translate("HoldRelease", "Hold to go on"))
        self.go_on.setProperty("role", "primary")
        self._hold_id = 0

    def show_status(self, status: RobotStatus | None, is_linked: bool = True) -> None:
        """Show what holds the robot, nothing where it is not held; is_linked: it hears the Operator."""
        notifications = () if status is None else status.notifications
        reason = next((each.text for each in notifications if each.code == HELD_CODE), "")
        hold_id = 0 if status is None or not is_linked else status.hold_id
        if hold_id != self._hold_id:
            # Whoever holds the button has seen another cause.
            self._hold_id = hold_id
            self.go_on.let_go()
        self.reason.setText(translated(reason))
        self.reason.setVisible(bool(hold_id and reason))
        self.go_on.setVisible(hold_id != 0)
