"""The header bar: Stop, steps of the test, status word, notifications, the Car's locks, link, battery, settings."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtGui import QResizeEvent
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from mtr_operator.station.view_model import ViewModel

from ..stopping import Stopping
from ..theme.appearance import Appearance
from ..theme.scale import S
from .presence_banner import PresenceBanner
from .reasons import blocked_text
from .status_word import StatusWord
from .step_bar import StepBar
from .stop_button import StopButton
from .symbols import BatterySymbol, CogwheelButton, LinkSymbol, LocksSymbol
from .warning_symbol import WarningSymbol

# All symbols fit beside the longest status word.
_WIDE_PX = 960


class HeaderBar(QWidget):
    """Attributes: stop: on the left, where no window that hangs over the screen's edge hides it. blocked: why the robot
    does not go on; hidden while it does. presence: asks whether the Operator is present. foreign: that another
    application controls it; hidden while none does.

    Signals: settings_wanted, bus_wanted.
    """

    settings_wanted = pyqtSignal()
    bus_wanted = pyqtSignal()

    def __init__(self, appearance: Appearance, stopping: Stopping, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("header")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.stop = StopButton(stopping)
        self.steps = StepBar([self.tr("Welcome"), self.tr("Measurement type"), self.tr("Measurement"),
                              self.tr("Protocol")], appearance)
        self.warning = WarningSymbol(appearance, stopping)
        self.status = StatusWord(stopping)
        self.locks = LocksSymbol(appearance)
        self.locks.clicked.connect(self.bus_wanted)
        self.link = LinkSymbol(appearance)
        self.battery = BatterySymbol(appearance)
        self.settings = CogwheelButton(appearance)
        self.settings.clicked.connect(self.settings_wanted)
        self.presence = PresenceBanner()
        self.blocked = QLabel()
        self.blocked.setWordWrap(True)
        self.blocked.setProperty("role", "banner")
        self.blocked.hide()
        self.foreign = QLabel(self.tr("Another application controls the robot: Stop in this window does not reach it. "
                                      "Stop it there, or by the emergency stop."))
        self.exposed = QLabel(self.tr("The link is not encrypted: whoever is in its network can move the robot."))
        for banner in (self.foreign, self.exposed):
            banner.setWordWrap(True)
            banner.setProperty("role", "banner")
            banner.hide()
        self._lay_out()

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.setSpacing(S)
        row.addWidget(self.stop)
        row.addWidget(self.steps, 1)
        for widget in (self.warning, self.status, self.locks, self.link, self.battery, self.settings):
            row.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(S, S, S, S)
        layout.setSpacing(S)
        layout.addLayout(row)
        layout.addWidget(self.presence)
        layout.addWidget(self.blocked)
        layout.addWidget(self.foreign)
        layout.addWidget(self.exposed)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """See QWidget; where there is no room the link is in the list behind the status word alone."""
        self.link.setVisible(event.size().width() >= _WIDE_PX)
        super().resizeEvent(event)

    def show_model(self, model: ViewModel) -> None:
        """Show the newest of robot and Car."""
        readiness = model.readiness
        self.status.show_readiness(readiness)
        self.status.show_checklist(model.checklist)
        age_s = model.silent_s if model.is_stale else None
        self.warning.show_notifications(model.notifications, age_s)
        blocked = blocked_text(readiness)
        self.blocked.setText(blocked)
        self.blocked.setVisible(bool(blocked))
        self.presence.setVisible(model.is_presence_wanted)
        self.foreign.setVisible(model.is_controlled_elsewhere)
        if model.robot is not None:
            self.battery.show_percent(model.robot.status.battery_percent, age_s)
            self.locks.show_locks(model.robot.lock_state, model.is_stale)
            self.link.show_secret(model.robot.is_secret, model.robot.is_exposed)
            self.exposed.setVisible(model.robot.is_exposed)
