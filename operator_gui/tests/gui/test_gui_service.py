"""Service mode in the settings window: entered after a question at any time, released by a held button. Hazard H23"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.robot_status import ServiceState
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station.readiness import Phase, ReadinessWord


@pytest.fixture
def answers(monkeypatch):
    """What the Operator answers to the question; the questions."""
    given, asked = [True], []

    def confirm(parent, title, question, words):
        asked.append(question)
        return given[-1]
    monkeypatch.setattr("mtr_operator.gui.windows.service_card.confirm", confirm)
    return given, asked


@pytest.fixture
def card(operator, answers):
    operator.click(operator.window.header.settings)
    found = operator.window.findChild(SettingsWindow).service
    operator.wait(lambda: found.state.text() == "Not active.")
    return found


def test_mode_is_entered_after_a_question_shown_in_words_and_released_by_a_held_button(operator, card, opener, answers):
    operator.click(card.enter)
    operator.wait(card.release.isVisible)
    assert len(answers[1]) == 1 and "lift and servos are disabled" in answers[1][0]
    assert not card.enter.isVisible() and any(desired.enters_service for desired in opener.sent)
    assert operator.model.readiness.word is ReadinessWord.NOT_READY and not operator.model.readiness.can_start
    assert any("service mode" in each.detail for each in operator.model.readiness.reasons)
    operator.hold(card.release)
    operator.wait(card.enter.isVisible)
    assert card.state.text() == "Not active." and not opener.sent[-1].enters_service


def test_second_answer_and_a_click_on_the_release_do_nothing(operator, card, opener, answers):
    answers[0].append(False)
    operator.click(card.enter)
    assert len(answers[1]) == 1 and not any(desired.enters_service for desired in opener.sent)


def test_entry_during_a_test_stops_the_robot_and_pauses_the_test(operator, answers, opener):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.settings)
    card = operator.window.findChild(SettingsWindow).service
    operator.click(card.enter)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    operator.wait(lambda: operator.model.robot is not None and operator.model.robot.status.is_in_service)
    assert not operator.window.measurement.resume.isEnabled()
    count = len(opener.sent)
    assert all(desired.stop for desired in opener.sent[count - 3:])


@pytest.mark.parametrize("case", [
    ({}, "in service mode", True), ({"robot_agrees_s": 42.4}, "within 42 s", True),
    ({"operator_agrees_s": 30.0}, "Released here", False)])
def test_what_is_still_missing_is_said(operator, card, opener, case):
    releases, shown, is_enabled = case
    operator.click(card.enter)
    operator.wait(card.release.isVisible)
    service = operator.model.robot.status.service
    opener.spoil_with(service=replace(service, **{"robot_agrees_s": math.nan, **releases}))
    operator.wait(lambda: shown in card.state.text())
    operator.wait(lambda: card.release.isEnabled() is is_enabled)


def test_robot_of_before_is_named_as_too_old(operator, card, opener):
    opener.spoil_with(service=None)
    operator.wait(lambda: "too old for service mode" in card.state.text())


def test_another_application_in_control_is_the_one_to_release_it(operator, card, opener):
    opener.spoil_with(service=ServiceState(True, 3), controlled_by_other=True)
    operator.wait(lambda: card.release.isVisible() and not card.release.isEnabled())
