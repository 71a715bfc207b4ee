"""The calibration window."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.robot_status import CarCheck, CarDimensions, CheckState, Mode, Notification, PressReport
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.windows.calibration_window import CalibrationWindow


@pytest.fixture
def window(operator, qtbot):
    made = CalibrationWindow(operator.application.flow)
    qtbot.addWidget(made)
    made.show()
    return made


def test_height_is_ordered_and_the_reported_one_follows(window, operator, opener):
    window.key_height.edit.setText("72,5")
    operator.click(window.send)
    operator.wait(lambda: window.reported["height"].text() == "72.5 cm")
    assert opener.sent[-1].key_height_m == pytest.approx(0.725)


def test_buttons_are_pressed_once_with_the_strength(window, operator, opener):
    window.strength.edit.setText("0.6")
    window.press_s.edit.setText("1")
    window.buttons[2].setChecked(True)
    operator.click(window.send)
    operator.wait(lambda: "Pressed for 1.00 s" in window.notice.text())
    operator.wait(lambda: opener.sent[-1].press is None)
    presses = {desired.press for desired in opener.sent if desired.press is not None}
    assert [(press.buttons, press.strength) for press in presses] == [((2,), 0.6)]
    assert "strength" not in window.reported


def test_calibration_says_whether_the_car_obeyed__B14(window, operator, opener):
    operator.wait(lambda: window.reported["locks"].text() == "locked")
    # So far from the Car the first press works, and the ones after it change its locks each time.
    opener.spoil_with(pose_valid=True)
    window.buttons[2].setChecked(True)
    operator.click(window.send)
    operator.wait(lambda: "The Car has answered: unlocked." in window.notice.text())
    assert window.reported["locks"].text() == "unlocked"


def test_calibration_says_that_the_car_did_not_obey__B14(window, operator, opener):
    window.buttons[2].setChecked(True)
    operator.click(window.send)
    operator.wait(lambda: window.notice.text().endswith("The Car has not answered."))
    assert window.reported["locks"].text() == "locked"


def test_reported_values_of_a_silent_robot_are_grey__B1(window, operator, opener):
    operator.wait(lambda: window.reported["height"].property("stale") is False)
    opener.is_silent = True
    operator.wait(lambda: window.reported["height"].property("stale"))


def test_buttons_held_down_are_shown(window, operator, opener):
    assert window.reported["buttons"].text() == "none"
    opener.spoil_with(pressed_buttons=(1, 2))
    operator.wait(lambda: window.reported["buttons"].text() == "Lock, Unlock")


def test_failed_press_is_told(window, operator, opener):
    opener.spoil_with(presses=(PressReport(1, 1.0, 1.0, "The servo does not answer."),))
    window.buttons[1].setChecked(True)
    operator.click(window.send)
    operator.wait(lambda: window.notice.text() == "The servo does not answer.")


@pytest.mark.parametrize(("field", "text"), [("key_height", "20"), ("key_height", "x"), ("strength", "2"),
                                             ("press_s", "")])
def test_invalid_value_is_told_and_cannot_be_sent(window, field, text):
    getattr(window, field).edit.setText(text)
    assert getattr(window, field).fault
    assert not window.send.isEnabled()


def test_silent_robot_gets_no_order(window, operator, opener):
    opener.is_silent = True
    operator.wait(lambda: not window.send.isEnabled())


def test_car_is_mapped_again_on_request_and_stopped(window, operator, opener):
    operator.wait(window.car.map.isEnabled)
    operator.click(window.car.map)
    operator.wait(lambda: opener.sent[-1].map_car_id == 1)
    assert not opener.sent[-1].stop
    opener.spoil_with(mode=Mode.MAPPING_CAR)
    operator.wait(lambda: window.car.notice.text() == "The robot maps the Car.")
    assert not window.car.map.isEnabled()
    operator.click(window.findChild(StopButton))
    operator.wait(lambda: opener.sent[-1].stop)
    assert opener.sent[-1].map_car_id == 1


def test_robot_that_is_held_on_its_way_round_the_car_is_had_go_on(window, operator, opener):
    operator.wait(window.car.map.isEnabled)
    operator.click(window.car.map)
    assert not window.hold.go_on.isVisible()
    opener.spoil_with(mode=Mode.MAPPING_CAR, hold_id=7,
                      notifications=(Notification("held", 3, "The robot was driven by hand."),))
    operator.wait(window.hold.go_on.isVisible)
    assert window.hold.reason.text() == "The robot was driven by hand."
    assert opener.sent[-1].resume_hold_id == 0
    operator.click(window.hold.go_on)
    operator.wait(lambda: opener.sent[-1].resume_hold_id == 7)
    opener.spoil_with(hold_id=0, notifications=())
    operator.wait(lambda: not window.hold.go_on.isVisible())


def test_position_of_the_car_is_checked_and_the_answer_told(window, operator, opener):
    opener.spoil_with(mode=Mode.FOLLOWING_WAYPOINT, car=CarDimensions(4.5, 1.8, 0.01, 0.01), car_check=CarCheck())
    operator.wait(window.car.check.isEnabled)
    assert "4.50 m by 1.80 m" in window.car.notice.text()
    operator.click(window.car.check)
    operator.wait(lambda: opener.sent[-1].check_car_id == 1)
    opener.spoil_with(car_check=CarCheck(1, CheckState.FAILED, message="The Car stands elsewhere."))
    operator.wait(lambda: window.car.notice.text() == "The Car stands elsewhere.")
