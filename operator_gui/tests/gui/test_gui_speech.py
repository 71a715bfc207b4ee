"""What is said aloud, without a voice."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
from types import SimpleNamespace

import pytest

from mtr_operator.gui.alerts.sounds import Sounds
from mtr_operator.gui.alerts.speech import Voice
from mtr_operator.gui.windows import appearance_form
from mtr_operator.gui.windows.settings_window import SettingsWindow


class Engine:
    """As QTextToSpeech, as far as it is used. said: sentences, and the languages that they were said in."""

    engines = ["speechd"]
    said = []

    @classmethod
    def availableEngines(cls):
        return cls.engines

    def stop(self):
        pass

    def setLocale(self, locale):
        self.language = locale.name()[:2]

    def say(self, text):
        self.said.append((self.language, text))


@pytest.fixture
def module(monkeypatch):
    monkeypatch.setattr(Engine, "said", [])
    return SimpleNamespace(QTextToSpeech=Engine)


@pytest.fixture
def said(operator, module):
    """Sentences that were said."""
    flow = operator.application.flow
    flow.store.change(dataclasses.replace(flow.store.settings, speaks=True))
    sounds = Sounds(flow, lambda: None, Voice(module))
    yield Engine.said
    sounds.deleteLater()


def test_begin_end_and_trouble_of_a_test_are_said(operator, opener, said):
    operator.begin()
    operator.wait(lambda: said)
    assert said == [("en", "The robot moves.")]
    opener.car_problem = problem = "No CAN frame for 0.6 s; check the plug, the bit rate and that the Car is awake."
    operator.wait(lambda: len(said) >= 2)
    assert problem in said[1][1]


def test_end_of_a_test_is_said(operator, said):
    operator.begin()
    operator.finish()
    operator.wait(lambda: ("en", "The test is done.") in said)


def test_nothing_is_said_unless_somebody_wants_it(operator, module):
    sounds = Sounds(operator.application.flow, lambda: None, Voice(module))
    operator.begin()
    operator.finish()
    assert not Engine.said
    sounds.deleteLater()


def test_computer_without_a_voice_says_nothing_and_the_setting_says_what_is_missing(operator, module, qtbot,
                                                                                    monkeypatch):
    monkeypatch.setattr(Engine, "engines", [])
    for voice in (Voice(None), Voice(module)):
        voice.say("The robot moves.")
    assert not Engine.said
    monkeypatch.setattr(appearance_form, "speech_module", lambda: None)
    window = SettingsWindow(operator.application.flow, operator.application.appearance)
    qtbot.addWidget(window)
    assert not window.looks.speech.isEnabled() and "python3-pyqt5.qttexttospeech" in window.looks.speech.toolTip()


def test_speech_is_remembered(operator, module, qtbot, monkeypatch):
    monkeypatch.setattr(appearance_form, "speech_module", lambda: module)
    flow = operator.application.flow
    window = SettingsWindow(flow, operator.application.appearance)
    qtbot.addWidget(window)
    assert window.looks.speech.isEnabled() and not window.looks.speech.isChecked()
    window.looks.speech.setChecked(True)
    assert flow.store.settings.speaks
