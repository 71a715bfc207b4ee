"""Beeps for what the Operator has to hear: one when the robot begins to move, two at the end, three at trouble."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from PyQt5.QtCore import QObject, QTimer
from PyQt5.QtWidgets import QApplication

from mtr_operator.station.alert import Heard, alert_of
from mtr_operator.station.view_model import ViewModel

from .flow import Flow

_GAP_MS = 250


class Sounds(QObject):
    """Belongs to the application. beep: what makes one."""

    def __init__(self, flow: Flow, beep: Callable[[], None] = QApplication.beep):
        super().__init__()
        self._flow = flow
        self._beep = beep
        self._left = 0
        self._heard = _heard(flow.model)
        self._timer = QTimer(self)
        self._timer.setInterval(_GAP_MS)
        self._timer.timeout.connect(self._go_on)
        flow.bridge.changed.connect(self._learn)

    def _learn(self) -> None:
        before, self._heard = self._heard, _heard(self._flow.model)
        alert = alert_of(before, self._heard)
        if alert is not None and self._flow.store.settings.has_sounds:
            self._left = alert.value
            self._go_on()

    def _go_on(self) -> None:
        if self._left:
            self._left -= 1
            self._beep()
            self._timer.start()
        else:
            self._timer.stop()


def _heard(model: ViewModel) -> Heard:
    return Heard(model.may_move, model.readiness.word, model.phase, bool(model.trouble))
