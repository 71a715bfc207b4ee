"""Stop: at hand in every window while the robot may move, by mouse and keyboard; the numbers are those of defects."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt, QTimer
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication, QFileDialog, QMessageBox

from mtr_operator.domain.robot_status import Mode, MotionSource, Notification, WaypointResult
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station.readiness import Phase


def opened(operator, kind):
    """The dialog of a kind that is open."""
    found = []
    operator.wait(lambda: found.extend(
        each for each in QApplication.topLevelWidgets() if isinstance(each, kind) and each.isVisible()) or found)
    QApplication.setActiveWindow(found[0])
    return found[0]


def press(key):
    """Press a key wherever the focus is."""
    QTest.keyClick(QApplication.focusWidget() or QApplication.activeWindow(), key)


def is_stopped(opener):
    return bool(opener.sent) and opener.sent[-1].stop


@pytest.fixture
def mapping(operator, opener):
    """The calibration window, with the robot on its way around the Car."""
    operator.click(operator.window.welcome.calibration)
    window = opened(operator, CalibrationWindow)
    operator.wait(window.car.map.isEnabled)
    operator.click(window.car.map)
    opener.spoil_with(mode=Mode.MAPPING_CAR)
    operator.wait(lambda: operator.window.header.status.text().endswith("Mapping"))
    assert not is_stopped(opener)
    return window


@pytest.mark.parametrize("leave", [
    lambda window: QTest.keyClick(window, Qt.Key_Escape), lambda window: QTest.keyClick(window, Qt.Key_Space),
    lambda window: window.close(), lambda window: window.reject()], ids=["Esc", "Space", "X", "Close"])
def test_leaving_calibration_stops_the_robot__A1(mapping, opener, leave):
    leave(mapping)
    assert is_stopped(opener)


def test_robot_that_maps_has_a_stop_in_the_main_window_and_the_focus_is_on_the_one_in_front__A1(mapping, operator):
    stop = mapping.findChild(StopButton)
    assert stop.isVisible() and stop.property("moving") and stop.hasFocus()
    header = operator.window.header.stop
    assert header.isVisible() and header.isEnabled() and header.property("moving")
    assert not mapping.isModal()


def test_stop_in_the_main_window_works_while_calibration_is_open__A1(mapping, operator, opener):
    operator.click(operator.window.header.stop)
    assert is_stopped(opener)
    operator.wait(lambda: not operator.window.header.stop.property("moving"))
    operator.wait(mapping.car.map.isEnabled)


def test_order_after_a_stop_does_not_let_the_mapping_go_on__A1(mapping, operator, opener):
    operator.click(mapping.findChild(StopButton))
    operator.click(mapping.send)
    operator.wait(lambda: not opener.sent[-1].stop)
    assert opener.sent[-1].map_car_id == 0


def test_closing_the_main_window_stops_a_robot_that_drives_without_a_test__A1(operator, opener):
    opener.spoil_with(motion_source=MotionSource.PLANNER, speed_mps=0.5)
    operator.wait(lambda: operator.window.header.status.text().endswith("Driving"))
    assert operator.window.close()
    assert is_stopped(opener)


def test_settings_leave_stop_at_hand_while_measuring__A3(operator, opener):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.settings)
    window = opened(operator, SettingsWindow)
    assert not window.isModal()
    stop = window.findChild(StopButton)
    assert stop.isVisible() and stop.hasFocus()
    operator.click(stop)
    assert is_stopped(opener)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    window.close()


def test_second_click_shows_the_settings_that_are_open(operator):
    operator.click(operator.window.header.settings)
    operator.click(operator.window.header.settings)
    assert len([each for each in QApplication.topLevelWidgets() if isinstance(each, SettingsWindow)]) == 1
    opened(operator, SettingsWindow).close()


def test_after_start_and_resume_the_focus_is_on_stop__A4(operator):
    QApplication.setActiveWindow(operator.window)
    screen = operator.begin()
    stop = operator.window.header.stop
    operator.wait(stop.hasFocus)
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(stop)
    operator.wait(screen.resume.isEnabled)
    operator.wait(lambda: not stop.property("moving"))
    operator.click(screen.resume)
    operator.wait(stop.hasFocus)
    operator.click(stop)


@pytest.mark.parametrize("key", [Qt.Key_Space, Qt.Key_Escape], ids=["Space", "Esc"])
@pytest.mark.parametrize("place", ["save", "view"])
def test_keys_stop_wherever_the_focus_is__A4(operator, opener, key, place):
    QApplication.setActiveWindow(operator.window)
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    (screen.save if place == "save" else screen.panel.view).setFocus()
    press(key)
    assert is_stopped(opener)
    assert operator.model.phase is Phase.STOPPING
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert not screen.note.text()


def test_text_field_takes_the_space_and_escape_leaves_it_before_it_stops__A4(mapping, opener):
    edit = mapping.key_height.edit
    edit.setFocus()
    edit.selectAll()
    press(Qt.Key_Space)
    assert edit.text() == " "
    press(Qt.Key_Escape)
    assert not edit.hasFocus() and mapping.isVisible() and not is_stopped(opener)
    press(Qt.Key_Escape)
    assert is_stopped(opener)


def test_keys_are_as_usual_while_the_robot_stands(operator, opener):
    operator.click(operator.window.header.settings)
    window = opened(operator, SettingsWindow)
    operator.wait(lambda: not operator.model.may_move)
    QTest.keyClick(window, Qt.Key_Escape)
    assert not window.isVisible() and not is_stopped(opener)
    QApplication.setActiveWindow(operator.window)
    operator.window.welcome.new.setFocus()
    press(Qt.Key_Space)
    assert operator.window.screen is operator.window.types


def test_list_of_the_status_word_has_a_stop_of_its_own__A3(operator, opener):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    popup = operator.window.header.status.popup
    operator.click(operator.window.header.status)
    assert popup.stop.isVisible()
    operator.click(popup.stop)
    assert is_stopped(opener) and not popup.isVisible()


@pytest.fixture
def seen(qtbot):
    """Is the next message or file dialog modal, and has it a Stop? A person presses that and closes it."""
    found, timer = [], QTimer()

    def look():
        for dialog in QApplication.topLevelWidgets():
            if isinstance(dialog, (QMessageBox, QFileDialog)) and dialog.isVisible():
                timer.stop()
                stop = dialog.findChild(StopButton)
                qtbot.mouseClick(stop, Qt.LeftButton)
                found.append((dialog.isModal(), stop.isVisible()))
                dialog.reject()
    timer.timeout.connect(look)
    timer.start(50)
    yield found
    timer.stop()


def test_message_while_measuring_is_not_modal_and_has_a_stop__A3(operator, opener, seen):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.application.flow.failed.emit("Something is to be known.")
    operator.wait(lambda: seen == [(False, True)])
    assert is_stopped(opener)


def test_folder_dialog_while_measuring_is_not_modal_and_has_a_stop__A3(operator, opener, seen):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.settings)
    opened(operator, SettingsWindow).choose_results()
    assert seen == [(False, True)]
    assert is_stopped(opener)


def test_closing_while_measuring_stops_first_and_then_asks__A3(operator, opener, seen, monkeypatch):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.sent.clear()
    stopped = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.confirm",
                        lambda *_: bool(stopped.append(is_stopped(opener))))
    operator.window.close()
    assert stopped == [True] and operator.window.isVisible()
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)


def test_stop_leaves_before_the_event_loop_runs_again_although_the_robot_is_silent__A4(operator, opener):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.is_silent = True
    operator.wait(lambda: "Communication lost" in operator.window.header.status.text())
    operator.bot.mousePress(operator.window.header.stop, Qt.LeftButton)
    assert is_stopped(opener)


def test_enter_presses_the_button_with_the_focus__B11(operator):
    QApplication.setActiveWindow(operator.window)
    operator.window.welcome.new.setFocus()
    press(Qt.Key_Return)
    assert operator.window.screen is operator.window.types


def test_enter_says_that_the_handle_is_taken_and_the_focus_goes_back_to_stop(operator):
    QApplication.setActiveWindow(operator.window)
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.hasFocus)
    press(Qt.Key_Return)
    operator.wait(lambda: operator.model.prompt is not None and operator.model.prompt.number == 2)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert operator.window.header.stop.hasFocus()


@pytest.mark.parametrize(("changes", "word", "sentence"), [
    ({"waypoint_result": WaypointResult.BLOCKED, "waypoint_message": "The robot is blocked by an obstacle."}, "Blocked",
     "Blocked: The robot is blocked by an obstacle."),
    ({"hold_id": 5, "notifications": (Notification("held", 3, "The robot was driven by hand."),)}, "Blocked",
     "Blocked: The robot was driven by hand."),
    ({"notifications": (Notification("peripherals_silent", 3, "The lift is silent."),)}, "Blocked",
     "Blocked: The lift is silent."),
    ({"mode": Mode.MAPPING_CAR}, "Mapping", ""), ({"mode": Mode.CHECKING_CAR}, "Checking", "")])
def test_header_says_what_the_robot_does_while_a_test_runs__B9(operator, opener, changes, word, sentence):
    operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(operator.window.measurement.taken.isVisible)
    header = operator.window.header
    operator.wait(lambda: header.status.text().endswith("Measuring"))
    opener.spoil_with(**changes)
    operator.wait(lambda: header.status.text().endswith(word))
    assert header.blocked.text() == sentence
    assert header.blocked.isVisible() is bool(sentence)
    operator.click(header.stop)


def test_window_of_a_robot_that_obeys_another_application_does_not_promise_to_stop_it(operator, opener):
    header = operator.window.header
    opener.spoil_with(motion_source=MotionSource.PLANNER, speed_mps=0.5)
    operator.wait(lambda: header.stop.property("moving"))
    assert not header.foreign.isVisible()
    opener.spoil_with(motion_source=MotionSource.PLANNER, speed_mps=0.5, controlled_by_other=True)
    operator.wait(header.foreign.isVisible)
    assert "does not reach it" in header.foreign.text() and header.status.text().endswith("Driving")
    assert not header.stop.property("moving") and header.stop.isEnabled()
    press(Qt.Key_Escape)
    assert not is_stopped(opener)
    operator.bot.mousePress(header.stop, Qt.LeftButton)
    assert is_stopped(opener)
