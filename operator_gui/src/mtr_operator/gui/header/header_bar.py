"""The header bar: steps of the test, status word, notifications, lock, battery, settings."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QWidget

from mtr_operator.station.view_model import ViewModel

from ..theme.appearance import Appearance
from ..theme.scale import M, S
from .status_word import StatusWord
from .step_bar import StepBar
from .symbols import BatterySymbol, CogwheelButton, LockSymbol
from .warning_symbol import WarningSymbol


class HeaderBar(QWidget):
    """Signals: settings_wanted."""

    settings_wanted = pyqtSignal()

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("header")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.steps = StepBar([self.tr("Welcome"), self.tr("Measurement type"), self.tr("Measurement"),
                              self.tr("Protocol")], appearance)
        self.warning = WarningSymbol(appearance)
        self.status = StatusWord()
        self.lock = LockSymbol(appearance)
        self.battery = BatterySymbol(appearance)
        self.settings = CogwheelButton(appearance)
        self.settings.clicked.connect(self.settings_wanted)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(M, S, M, S)
        layout.setSpacing(M)
        layout.addWidget(self.steps, 1)
        for widget in (self.warning, self.status, self.lock, self.battery, self.settings):
            layout.addWidget(widget)

    def show_model(self, model: ViewModel) -> None:
        """Show the newest of robot and Car."""
        self.status.show_readiness(model.readiness)
        self.warning.show_notifications(model.notifications)
        if model.robot is not None:
            self.battery.show_percent(model.robot.status.battery_percent)
            self.lock.show_closed(model.robot.is_secret)
