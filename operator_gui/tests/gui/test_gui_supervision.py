"""A real robot in the window: conditions before the start, a person who is asked, signals of the Car that stop it."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtWidgets import QShortcut

from mtr_operator.domain.robot_status import PreflightReport
from mtr_operator.domain.supervision.car_signals import IGNITION, CarSignal, SignalState
from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.station.alert import Alert, Heard, alert_of
from mtr_operator.station.links import worker
from mtr_operator.station.readiness import Phase, ReadinessWord

# 26 November 2026.
NOW_S = 1_795_651_200.0


@pytest.fixture
def real(operator, opener):
    """The operator at a robot whose clock tells the date, after its preflight in motion."""
    def of_real(status):
        steady_s = 50_000.0 + status.stamp_s
        return dataclasses.replace(status, sent_s=NOW_S + status.stamp_s, steady_s=steady_s, waits_for_answer=False,
                                   simulated=False,
                                   preflight=PreflightReport(50_000.0, (), 40, 0, 50_000.0))
    opener.spoil = of_real
    operator.wait(lambda: operator.model.robot.status.steady_s > 50_000.0)
    operator.wait(lambda: operator.model.robot.preflight is not None and operator.model.robot.preflight.made_s > 0.0)
    return operator


def confirm(screen):
    """All that a person says before a start."""
    screen.identity.fields["person_in_charge"].show_text("M. Svoboda")
    for box in screen.conditions.boxes.values():
        box.setChecked(True)


def test_simulated_robot_asks_for_nothing(operator):
    screen = operator.choose("key_press")
    operator.wait(screen.start.isEnabled)
    assert not screen.conditions._rows.isVisible()
    assert screen.conditions.announcement.isVisible() and "horn" in screen.conditions.announcement.text()
    operator.begin()
    operator.finish()


def test_real_robot_starts_once_everything_is_confirmed_and_the_record_says_so(real):
    screen = real.choose("key_press")
    real.wait(screen.conditions._rows.isVisible)
    assert not screen.start.isEnabled() and "person in charge" in screen._hindrance.text()
    screen.identity.fields["person_in_charge"].show_text("M. Svoboda")
    assert not screen.start.isEnabled() and "operating condition" in screen._hindrance.text()
    for box in screen.conditions.boxes.values():
        assert not screen.start.isEnabled()
        box.setChecked(True)
    assert screen.start.isEnabled() and set(real.model.wanted.confirmed) == set(CONDITIONS)
    screen.form.fields["angle_between_radials_rad"].edit.setText("90")
    real.click(screen.start)
    real.finish()
    progress = real.model.test.progress
    assert progress.session["operating conditions confirmed"] == ", ".join(CONDITIONS)
    assert progress.session["supervision"] == "person present, asked every 15 min"
    assert progress.identity.person_in_charge == "M. Svoboda"
    # The next test asks again.
    assert real.choose("key_press").conditions.confirmed == ()


class Clock:
    """Wall time of the presence, which a test sets: a busy machine answers no question late."""

    def __init__(self):
        self.now_s = 0.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def clock(real, monkeypatch):
    """In place of the clock of the presence."""
    made = Clock()
    monkeypatch.setattr(real.application.flow.connecting.worker._presence, "_clock", made)
    return made


def begin(real):
    """A test on a real robot, as far as a handle that nobody pulls."""
    screen = real.choose("handle_request")
    for name, text in {"measurements_distance_m": "10", "maximum_distance_m": "3", "border_distance_m": "1.8",
                       "handle_timeout_s": "3600"}.items():
        screen.form.fields[name].edit.setText(text)
    confirm(screen)
    real.wait(screen.start.isEnabled)
    real.click(screen.start)
    real.wait(real.window.measurement.taken.isVisible)
    return real.window.measurement


def test_person_who_is_asked_answers_by_click_or_key_and_keeps_the_focus_on_stop(real, clock):
    begin(real)
    header = real.window.header
    shortcut, = header.presence.findChildren(QShortcut)
    assert shortcut.key().toString() == "F9" and shortcut.context() == Qt.ApplicationShortcut
    for answer in (lambda: real.click(header.presence.present), shortcut.activated.emit):
        clock.now_s += 900.0
        real.wait(header.presence.isVisible)
        assert header.stop.isVisible() and not header.presence.present.hasFocus()
        answer()
        real.wait(header.presence.isHidden)
        assert real.model.phase is Phase.MEASURING
    # A key that is pressed while nothing is asked says nothing.
    shortcut.activated.emit()
    real.click(header.stop)
    real.wait(lambda: real.model.phase is Phase.PAUSED)


def test_unanswered_question_pauses_the_test_which_resumes_with_the_person(real, clock):
    screen = begin(real)
    clock.now_s += 900.0
    real.wait(real.window.header.presence.isVisible)
    clock.now_s += 60.0
    real.wait(lambda: real.model.phase is Phase.PAUSED)
    assert screen.trouble.text().startswith("Nobody confirmed within 60 s to be present")
    assert real.window.header.presence.isHidden()
    assert screen.conditions.isVisible() and "confirms that the operating conditions hold" in screen.conditions.text()
    real.wait(screen.resume.isEnabled)
    real.click(screen.resume)
    real.wait(screen.taken.isVisible)
    real.click(real.window.header.stop)
    real.wait(lambda: real.model.phase is Phase.PAUSED)


def test_question_makes_a_sound():
    quiet = Heard(True, ReadinessWord.MEASURING, Phase.MEASURING, False)
    asked = dataclasses.replace(quiet, is_asked=True)
    assert alert_of(quiet, asked) is Alert.ASKED and alert_of(asked, asked) is None
    assert alert_of(quiet, dataclasses.replace(asked, has_trouble=True)) is Alert.TROUBLE


def test_ignition_pauses_the_test_and_hinders_its_resumption(operator, monkeypatch):
    state = [SignalState.CLEAR]
    link = operator.application.flow.connecting.worker._links.car
    monkeypatch.setattr(type(link), "signals", property(
        lambda _: (CarSignal(IGNITION, "Terminal of Power", state[0]),)))
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    state[0] = SignalState.ACTIVE
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert screen.trouble.text() == ("The robot was stopped. The Car's ignition is on (signal Terminal of Power). "
                                     "Secure the Car, then continue the test.")
    operator.wait(lambda: not screen.resume.isEnabled())
    state[0] = SignalState.CLEAR
    operator.wait(screen.resume.isEnabled)


def test_worker_asks_every_quarter_of_an_hour_by_default():
    assert worker.PresenceParameters() == worker.PresenceParameters(900.0, 60.0)
