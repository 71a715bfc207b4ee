"""Beeps for what the Operator has to hear: one when the robot begins to move, two at the end, three at trouble,
four to ask for presence.

And words, where they are wanted and the computer can speak.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from PyQt5.QtCore import QObject, QTimer
from PyQt5.QtWidgets import QApplication

from mtr_operator.station.alert import Alert, Heard, alert_of
from mtr_operator.station.readiness import ReadinessWord
from mtr_operator.station.view_model import ViewModel

from ..flow import Flow
from ..header.reasons import blocked_text, reason_text, word_text
from ..i18n import translate
from ..sentences import translated
from .speech import Voice, speech_module

_GAP_MS = 250


class Sounds(QObject):
    """Belongs to the application. beep: what makes one. voice: what says the words; that of the computer otherwise."""

    def __init__(self, flow: Flow, beep: Callable[[], None] = QApplication.beep, voice: Voice | None = None):
        super().__init__()
        self._flow = flow
        self._beep = beep
        self.voice = voice or Voice(speech_module())
        self._left = 0
        self._heard = _heard(flow.model)
        self._timer = QTimer(self)
        self._timer.setInterval(_GAP_MS)
        self._timer.timeout.connect(self._go_on)
        flow.bridge.changed.connect(self._learn)

    def _learn(self) -> None:
        before, self._heard = self._heard, _heard(self._flow.model)
        alert = alert_of(before, self._heard)
        settings = self._flow.store.settings
        if alert is not None and settings.has_sounds:
            self._left = alert.value
            self._go_on()
        if alert is not None and settings.speaks:
            self.voice.say(spoken(alert, self._flow.model))

    def _go_on(self) -> None:
        if self._left:
            self._left -= 1
            self._beep()
            self._timer.start()
        else:
            self._timer.stop()


def spoken(alert: Alert, model: ViewModel) -> str:
    """An alert in words."""
    if alert is Alert.DONE:
        return translate("Status", "The test is done.")
    if alert is Alert.MOVES:
        return translate("Status", "The robot moves.")
    if alert is Alert.ASKED:
        return translate("Status", "Confirm that you are present.")
    readiness = model.readiness
    if model.trouble:
        return translated(model.trouble)
    if readiness.word is ReadinessWord.BLOCKED:
        return blocked_text(readiness)
    return " ".join((f"{word_text(readiness.word)}.", *map(reason_text, readiness.reasons[:1])))


def _heard(model: ViewModel) -> Heard:
    return Heard(model.may_move, model.readiness.word, model.phase, bool(model.trouble),
                 model.is_presence_wanted)
