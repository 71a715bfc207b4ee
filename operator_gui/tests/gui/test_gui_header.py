"""The header bar: steps, status word, notifications, battery, lock."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import QAbstractAnimation

from mtr_operator.domain.robot_status import Mode, Notification
from mtr_operator.gui.header.symbols import BatterySymbol, LockSymbol
from mtr_operator.gui.header.warning_symbol import PULSE_MS, PULSE_SCALE, WarningSymbol
from mtr_operator.gui.theme.appearance import Appearance

LOW = Notification("peripherals", 2, "The lift is slow.")
LOST = Notification("peripherals_silent", 3, "The node of lift and buttons is silent.")


def test_steps_follow_the_screens(operator):
    steps = operator.window.header.steps
    assert (steps.selected, steps.accessibleName()) == (0, "Step 1 of 4: Welcome")
    operator.choose("key_press")
    assert steps.accessibleName() == "Step 2 of 4: Measurement type"


def test_triangle_is_only_there_with_a_notification_and_lists_all(operator, opener):
    triangle = operator.window.header.warning
    assert not triangle.isVisible()
    opener.spoil_with(notifications=(LOW, LOST))
    operator.wait(triangle.isVisible)
    assert triangle.toolTip().splitlines() == [LOST.text, LOW.text]
    operator.click(triangle)
    assert triangle.popup.texts()[1:] == [LOST.text, LOW.text]
    triangle.popup.hide()
    opener.spoil_with(notifications=())
    operator.wait(lambda: not triangle.isVisible())


def test_triangle_pulses_once_for_each_new_notification(operator, qtbot):
    triangle = WarningSymbol(Appearance(), operator.application.stopping)
    qtbot.addWidget(triangle)
    assert (triangle.pulse.duration(), triangle.pulse.startValue(), triangle.pulse.endValue()) == (200, 1.0, 1.2)
    assert (PULSE_MS, PULSE_SCALE) == (200, 1.2)
    triangle.show_notifications([LOW])
    assert triangle.pulse.state() == QAbstractAnimation.Running
    triangle.pulse.setCurrentTime(PULSE_MS // 2)
    assert triangle.scale == pytest.approx(1.1)
    triangle.pulse.setCurrentTime(PULSE_MS)
    assert triangle.scale == 1.0
    triangle.show_notifications([LOW])
    assert triangle.pulse.state() == QAbstractAnimation.Stopped
    triangle.show_notifications([LOW, LOST])
    assert triangle.pulse.state() == QAbstractAnimation.Running


def test_status_word_says_each_reason_with_an_advice(operator, opener):
    status = operator.window.header.status
    operator.wait(lambda: "Ready" in status.text())
    opener.spoil_with(battery_percent=5, mode=Mode.STARTING)
    operator.wait(lambda: "Not ready" in status.text())
    operator.click(status)
    texts = status.popup.texts()
    status.popup.hide()
    assert texts[0] == "Not ready"
    assert "The robot's battery is nearly empty: 5 %." in texts
    assert "Charge the battery before the test." in texts
    assert "The robot is still starting." in texts


def test_warning_alone_does_not_hinder_a_test(operator, opener):
    opener.spoil_with(battery_percent=20)
    operator.wait(lambda: "Ready with warnings" in operator.window.header.status.text())
    screen = operator.choose("autolock")
    operator.wait(screen.start.isEnabled)


def test_silent_robot_is_told_and_comes_back(operator, opener):
    status = operator.window.header.status
    opener.is_silent = True
    operator.wait(lambda: "Communication lost" in status.text())
    assert "The robot has not answered for" in status.toolTip()
    opener.is_silent = False
    operator.wait(lambda: "Ready" in status.text())


def test_battery_is_shown_in_percent(operator, opener):
    opener.spoil_with(battery_percent=63)
    operator.wait(lambda: operator.window.header.battery.toolTip() == "Battery of the robot: 63 %")


def test_unknown_battery_is_not_a_number(qtbot):
    battery = BatterySymbol(Appearance())
    qtbot.addWidget(battery)
    assert battery.accessibleName() == "Battery of the robot: unknown"


def test_lock_is_closed_only_on_an_encrypted_link(qtbot):
    lock = LockSymbol(Appearance())
    qtbot.addWidget(lock)
    assert lock.toolTip() == "The link to the robot is not encrypted."
    lock.show_closed(True)
    assert lock.toolTip() == "The link to the robot is encrypted."
