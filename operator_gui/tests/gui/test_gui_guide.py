"""The guided calibration."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from fit_checks import assert_fits, tell, visible
from PyQt5.QtCore import QSize

from mtr_operator.domain.robot_status import PressReport
from mtr_operator.gui.calibration.guide_window import GuideWindow
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.storage.given_files import load_calibration


@pytest.fixture
def window(operator, qtbot):
    made = GuideWindow(operator.application.flow)
    qtbot.addWidget(made)
    made.show()
    made.robot.show_text("MTR-1")
    made.by.show_text("J. Novak")
    return made


def record_of(operator):
    path = operator.application.flow.store.settings.calibration
    return path and load_calibration(path)


def test_lever_by_rule_is_kept_with_its_date_and_used_by_the_next_test(window, operator):
    window.lever.front.show_text("12,8 13.0 12,9")
    assert not window.lever.keep.isEnabled()
    window.lever.rear.show_text("39 39,2 39,1")
    operator.wait(window.lever.keep.isEnabled)
    assert window.lever.result.text().startswith(
        "The key is 26.0 cm ahead of the robot's middle (\u00b10.8 mm, 1 sigma)")
    operator.click(window.lever.keep)
    stated_m = operator.model.robot.status.key_x
    record = record_of(operator)
    assert record.terms["key_lever_m"].value == pytest.approx(0.26 - stated_m)
    assert (record.robot, record.by, [check.name for check in record.checks]) == ("MTR-1", "J. Novak", ["key_lever_m"])
    assert "MTR-1.yaml" in window.notice.text()
    screen = operator.choose("key_press")
    assert screen.given.calibration.path == operator.application.flow.store.settings.calibration


@pytest.mark.parametrize(("front", "fault", "result"), [
    ("12 x", "These are not numbers with a blank between them.", ""),
    ("12", "", "There are 1 readings to the front axle and 3 to the rear one; give as many of both.")])
def test_readings_that_cannot_be_used_are_told(window, operator, front, fault, result):
    window.lever.rear.show_text("39 39,2 39,1")
    window.lever.front.show_text(front)
    assert window.lever.front.fault == fault
    operator.wait(lambda: window.lever.result.text() == result)
    assert not window.lever.keep.isEnabled()


def test_height_is_ordered_and_read_at_three_places(window, operator):
    height = window.heights
    for wanted, tape in (("60", "61,0"), ("100", "101,1"), ("140", "141,2")):
        height.wanted.edit.setText(wanted)
        operator.wait(height.go.isEnabled)
        operator.click(height.go)
        reported_m = float(wanted) / 100.0
        operator.wait(lambda wanted_m=reported_m: abs(operator.model.robot.status.key_height_m - wanted_m) < 0.001)
        height.tape.show_text(tape)
        operator.wait(height.take.isEnabled)
        operator.click(height.take)
    assert "The key is 11.0 mm higher than the robot reports" in height.result.text()
    operator.click(height.keep)
    assert record_of(operator).key_height_offset_m == pytest.approx(0.011, abs=1e-4)
    operator.click(height.forget)
    assert height.readings == []
    assert not height.keep.isEnabled()


def test_press_strength_is_found_by_the_answer_of_the_car(window, operator, opener):
    opener.spoil_with(pose_valid=True)
    operator.wait(window.press.begin.isEnabled)
    operator.click(window.press.begin)
    assert not window.press.begin.isEnabled()
    operator.wait(window.press.keep.isEnabled)
    assert window.press.result.text() == "The Car answers each time from a strength of 0.20 on (4 presses)."
    operator.click(window.press.keep)
    check = record_of(operator).check_named("press_strength")
    assert (check.value, check.source) == (0.2, "answers of the Car, 4 presses in steps of 0.1")


def test_stop_ends_the_search_for_the_strength(window, operator, opener):
    # The Car hears nothing, so the search would go on.
    opener.spoil_with(presses=(), key_x=50.0)
    operator.click(window.press.begin)
    operator.wait(lambda: window.press.result.text().startswith("Press 1"))
    operator.application.flow.stop()
    assert window.press.result.text() == "Stopped."
    operator.wait(window.press.begin.isEnabled)


def test_refused_press_is_told(window, operator, opener):
    opener.spoil_with(presses=(PressReport(1, 1e6, 1e6, "The servo does not answer."),))
    operator.click(window.press.begin)
    operator.wait(lambda: window.press.result.text() == "The servo does not answer.")


def test_nothing_is_kept_without_a_name(window, operator):
    window.by.show_text("")
    window.lever.front.show_text("12,8 13.0 12,9")
    window.lever.rear.show_text("39 39,2 39,1")
    operator.wait(window.lever.keep.isEnabled)
    operator.click(window.lever.keep)
    assert window.by.fault == "Enter it before something is kept."
    assert record_of(operator) is None


def test_damaged_record_is_told_at_its_field(window, tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("robot: MTR-1\n")
    window.file._change(path)
    assert "date is missing." in window.file.field.fault


def test_calibration_window_opens_the_guide_which_is_not_modal(operator):
    operator.click(operator.window.welcome.calibration)
    [calibration] = operator.window.findChildren(CalibrationWindow)
    operator.click(calibration.guide)
    [guide] = operator.window.findChildren(GuideWindow)
    assert guide.isVisible() and not guide.isModal()
    assert visible(guide, StopButton)
    guide.close()
    calibration.close()


def test_guide_fits_and_has_its_stop_in_sight(application, main, show, monkeypatch):
    window = show(lambda: GuideWindow(application.flow, main))
    tell(application, key_x=0.25)
    window.lever.front.show_text("12,8 13.0 12,9")
    window.lever.rear.show_text("39 39,2 39,1")
    window.heights.readings.extend([(0.61, 0.6), (1.011, 1.0), (1.41, 1.4)])
    window.heights._judge()
    window._keep(lambda record, signed: record)
    assert window.lever.keep.isEnabled() and window.heights.keep.isEnabled()
    assert_fits(window, monkeypatch, QSize(820, 860))
