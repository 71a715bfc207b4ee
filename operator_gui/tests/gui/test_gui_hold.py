"""What moves the robot is held, not clicked; the checklist behind the status word; sounds. Numbers are of defects."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest
from fit_checks import tell
from PyQt5.QtCore import QEvent, QRect, Qt
from PyQt5.QtGui import QKeyEvent
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.robot_status import EmergencyStop, Mode
from mtr_operator.gui.alerts.sounds import Sounds
from mtr_operator.gui.forms.hold_button import HoldButton
from mtr_operator.gui.header import popup
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station.readiness import Phase

# Before the fixtures of this folder shorten it.
SHIPPED_MS = HoldButton.HOLD_MS
# Rows of the checklist behind the status word.
LISTED = ["Link", "Encryption", "Robot", "Preflight", "Emergency stop", "Position", "Test area", "Car's size",
          "Way of the lines", "Stop trial", "Ground next to the Car", "Cables", "Doors and lids", "Fittings", "Area",
          "People", "Weather", "Light", "Car", "Attendance", "LiDARs", "Lift and buttons", "Battery", "CAN bus",
          "Car's locks", "Car's signals", "Clocks", "Robot's clock", "Remote key", "Disk", "Limits"]
# Of the checks that no sensor makes.
UNSEEN_ADVICE = ["Press the stop button", "Walk around the Car", "Put the laptop into the Car", "Close doors",
                 "Remove carriers"]
# Operating conditions that a person confirms.
CONDITIONS = ["Area", "People", "Weather", "Light", "Car", "Attendance"]
KEYS = pytest.mark.parametrize("key", [Qt.Key_Space, Qt.Key_Return, Qt.Key_Enter], ids=["Space", "Return", "Enter"])


@pytest.fixture
def button(qtbot, monkeypatch):
    """A button that wants to be held for 0.15 s, and how often it was held."""
    monkeypatch.setattr(HoldButton, "HOLD_MS", 150)
    made = HoldButton("Hold to start")
    made.times = 0

    def count():
        made.times += 1
    made.held.connect(count)
    qtbot.addWidget(made)
    made.show()
    QApplication.setActiveWindow(made)
    made.setFocus()
    return made


def test_it_is_held_for_one_and_a_half_seconds__B8():
    assert SHIPPED_MS == 1500


def test_click_does_nothing__B8(button, qtbot):
    qtbot.mouseClick(button, Qt.LeftButton)
    button.click()
    qtbot.wait(250)
    assert button.times == 0


def test_held_with_the_mouse_it_acts_once__B8(button, qtbot):
    qtbot.mousePress(button, Qt.LeftButton)
    qtbot.waitUntil(lambda: button.times == 1)
    qtbot.wait(250)
    qtbot.mouseRelease(button, Qt.LeftButton)
    assert button.times == 1 and not button.isDown()


@KEYS
def test_held_with_a_key_it_acts_once__B8(button, qtbot, key):
    QTest.keyPress(button, key)
    for _ in range(3):
        QApplication.sendEvent(button, QKeyEvent(QEvent.KeyPress, key, Qt.NoModifier, "", True))
    qtbot.waitUntil(lambda: button.times == 1)
    QTest.keyRelease(button, key)
    qtbot.wait(200)
    assert button.times == 1


@KEYS
def test_key_let_go_early_does_nothing__B8(button, qtbot, key):
    QTest.keyPress(button, key)
    QTest.keyRelease(button, key)
    qtbot.wait(250)
    assert button.times == 0


@pytest.mark.parametrize("end", [lambda button: button.setEnabled(False), lambda button: button.hide(),
                                 lambda button: button.clearFocus()], ids=["disabled", "hidden", "focus lost"])
def test_what_comes_in_between_ends_the_hold__B8(button, qtbot, end):
    qtbot.mousePress(button, Qt.LeftButton)
    end(button)
    qtbot.wait(250)
    assert button.times == 0


def test_click_on_start_and_resume_moves_nothing__B8(operator, opener, qtbot, monkeypatch):
    monkeypatch.setattr(HoldButton, "HOLD_MS", 400)
    screen = operator.choose("key_press")
    operator.wait(screen.start.isEnabled)
    qtbot.mouseClick(screen.start, Qt.LeftButton)
    qtbot.wait(100)
    assert operator.window.screen is screen and operator.model.phase is Phase.IDLE
    operator.hold(screen.start)
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    measurement = operator.window.measurement
    operator.wait(measurement.resume.isEnabled)
    qtbot.mouseClick(measurement.resume, Qt.LeftButton)
    qtbot.wait(100)
    assert operator.model.phase is Phase.PAUSED


def test_click_on_mapping_and_check_moves_nothing__B8(operator, opener, qtbot, monkeypatch):
    monkeypatch.setattr(HoldButton, "HOLD_MS", 400)
    window = CalibrationWindow(operator.application.flow)
    qtbot.addWidget(window)
    window.show()
    operator.wait(window.car.map.isEnabled)
    qtbot.mouseClick(window.car.map, Qt.LeftButton)
    qtbot.wait(100)
    assert not opener.sent[-1].map_car_id
    operator.hold(window.car.map)
    operator.wait(lambda: opener.sent[-1].map_car_id == 1)


@KEYS
def test_key_that_is_still_held_does_not_stop_what_it_has_started__B8(operator, opener, key):
    QApplication.setActiveWindow(operator.window)
    screen = operator.choose("key_press")
    operator.wait(screen.start.isEnabled)
    screen.start.setFocus()
    QTest.keyPress(screen.start, key)
    operator.wait(lambda: operator.model.phase is Phase.MEASURING and operator.window.header.stop.hasFocus())
    for _ in range(5):
        QApplication.sendEvent(QApplication.focusWidget(), QKeyEvent(QEvent.KeyPress, key, Qt.NoModifier, "", True))
    assert operator.model.phase is Phase.MEASURING
    QTest.keyClick(QApplication.focusWidget(), Qt.Key_Space)
    assert operator.model.phase is Phase.STOPPING


def rows(operator):
    operator.click(operator.window.header.status)
    texts = operator.window.header.status.checklist.texts()
    operator.window.header.status.popup.hide()
    return texts


def test_status_word_lists_everything_that_was_looked_at__B10(operator):
    operator.wait(lambda: operator.model.free_bytes is not None)
    texts = rows(operator)
    assert [name for text, name in zip(texts, LISTED) if text[1:].startswith(f" {name} ")] == LISTED
    assert len(texts) == len(LISTED)
    assert "\N{CHECK MARK} Encryption Not encrypted; it does not leave this computer." in texts
    assert "\N{CHECK MARK} Battery At 80 %; what a test takes is told when it is chosen." in texts
    assert "\N{CHECK MARK} Car's locks The Car says: locked." in texts


def test_what_no_sensor_shows_is_left_to_a_person_with_what_to_do__B10(operator):
    texts, first = rows(operator), LISTED.index("Stop trial")
    for name, text, advice in zip(LISTED[first:], texts[first:], UNSEEN_ADVICE):
        assert text.startswith(f"? {name} ") and f". {advice}" in text and text.endswith(".")
        # What is not seen, why, and what to do: three lines of the list, in short sentences.
        sentences = text[len(f"? {name} "):].split(". ")
        assert len(text) <= 250 and max(len(sentence.split()) for sentence in sentences) <= 25


def test_operating_conditions_are_questions_to_a_person(operator):
    texts, first = rows(operator), LISTED.index("Area")
    for name, text in zip(CONDITIONS, texts[first:]):
        assert text.startswith(f"? {name} ") and text.endswith("?") and len(text) <= 150


def test_checklist_knows_the_test_that_is_chosen_and_follows_what_happens__B10(operator, opener):
    operator.choose("key_press")
    status = operator.window.header.status
    operator.click(status)
    assert status.popup.isVisible()
    operator.wait(lambda: any("the test takes about" in text for text in status.checklist.texts()))
    opener.spoil_with(emergency_stop=EmergencyStop.ENGAGED, battery_percent=5)
    operator.wait(lambda: any("Nearly empty: 5 %. Charge it before the test." in text
                              for text in status.checklist.texts()))
    assert any("is engaged" in text for text in status.checklist.texts())
    assert status.popup.texts() == ["Not ready"]
    status.popup.hide()


def test_list_stays_within_a_small_screen__B10(operator, monkeypatch):
    monkeypatch.setattr(popup, "available", lambda _: QRect(0, 0, 853, 480))
    operator.window.move(0, 0)
    operator.click(operator.window.header.status)
    shown = operator.window.header.status.popup
    assert QRect(0, 0, 853, 480).contains(shown.geometry())
    shown.hide()


def test_full_disk_hinders_the_start_with_a_sentence(operator, monkeypatch):
    screen = operator.choose("key_press")
    operator.wait(screen.start.isEnabled)
    monkeypatch.setattr(operator.application.flow._disk, "free", 1_000_000)
    operator.wait(lambda: not screen.start.isEnabled())
    assert screen._hindrance.text() == "Nearly full: 0.0 GB are free."


def test_start_tells_why_not_in_the_words_of_the_checklist(operator, opener):
    screen = operator.choose("key_press")
    opener.spoil_with(mode=Mode.STARTING)
    # A busy machine may find it silent before.
    operator.wait(lambda: screen._hindrance.text() == "The robot is still starting.")
    assert not screen.start.isEnabled()


def test_start_is_offered_again_after_a_silence_that_began_while_the_screen_was_drawn(application, main, monkeypatch):
    screen, model = main.settings["key_press"], application.flow.model
    passed_s = [model._clock()]
    monkeypatch.setattr(model, "_clock", lambda: passed_s[0])
    main.types.chosen.emit("key_press")
    tell(application, simulated=True)
    assert screen.start.isEnabled() and not screen._hindrance.text()
    draw = screen._show_obstacles

    def draw_slowly():
        passed_s[0] += 2.0
        draw()
    monkeypatch.setattr(screen, "_show_obstacles", draw_slowly)
    tell(application, battery_percent=70, simulated=True)
    assert not screen.start.isEnabled() and screen._hindrance.text()
    tell(application, battery_percent=70, simulated=True)
    assert screen.start.isEnabled() and not screen._hindrance.text()


@pytest.fixture
def beeps(operator):
    """How often it beeped."""
    made = []
    sounds = Sounds(operator.application.flow, lambda: made.append(1))
    sounds._timer.setInterval(1)
    yield made
    sounds.deleteLater()


def test_start_and_end_of_a_test_are_heard(operator, beeps):
    operator.begin()
    operator.wait(lambda: len(beeps) == 1)
    operator.finish()
    operator.wait(lambda: len(beeps) == 3)


def test_trouble_is_heard(operator, opener, beeps):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    del beeps[:]
    opener.car_problem = "No CAN frame for 0.6 s; check the plug, the bit rate and that the Car is awake."
    operator.wait(lambda: len(beeps) >= 3)


def test_sounds_can_be_switched_off(operator, beeps, qtbot):
    flow = operator.application.flow
    window = SettingsWindow(flow, operator.application.appearance)
    qtbot.addWidget(window)
    window.looks.sounds.setChecked(False)
    assert not flow.store.settings.has_sounds
    operator.begin()
    operator.finish()
    assert not beeps
    flow.store.change(dataclasses.replace(flow.store.settings, has_sounds=True))
