"""The header bar: steps, status word, notifications, battery, lock."""
# SPDX-License-Identifier: Apache-2.0
import time

import pytest
from PyQt5.QtCore import QAbstractAnimation
from PyQt5.QtWidgets import QApplication, QStyle, QStyleOptionButton

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import Mode, Notification, PreflightItem, PreflightReport
from mtr_operator.gui.header.symbols import BatterySymbol, LinkSymbol, LocksSymbol
from mtr_operator.gui.header.warning_symbol import PULSE_MS, PULSE_SCALE, WarningSymbol
from mtr_operator.gui.theme.appearance import Appearance
from mtr_operator.station.readiness import Readiness, ReadinessWord

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
    texts = status.checklist.texts()
    status.popup.hide()
    assert status.popup.texts() == ["Not ready"]
    assert "\N{MULTIPLICATION X} Battery Nearly empty: 5 %. Charge it before the test." in texts
    assert "\N{MULTIPLICATION X} Robot The robot is still starting. Wait a moment." in texts


@pytest.mark.parametrize("state", [QStyle.State_None, QStyle.State_HasFocus, QStyle.State_MouseOver])
@pytest.mark.parametrize("word", ReadinessWord)
def test_status_word_is_not_cut_by_its_frame(operator, word, state):
    status = operator.window.header.status
    status.show_readiness(Readiness(word, ()))
    QApplication.processEvents()
    option = QStyleOptionButton()
    status.initStyleOption(option)
    option.state = option.state & ~QStyle.State_HasFocus | state
    inside = status.style().subElementRect(QStyle.SE_PushButtonContents, option, status)
    assert inside.width() >= status.fontMetrics().horizontalAdvance(status.text())


@pytest.fixture
def robot_of_before(opener):
    """It says nothing of a preflight from its first word on."""
    opener.spoil_with(preflight=None)


def test_robot_that_says_nothing_of_a_preflight_is_told(robot_of_before, operator):
    operator.wait(lambda: "Ready" in operator.window.header.status.text())
    assert ("? Preflight The robot does not say whether one was made. Make it on the robot: rosrun "
            "mtr_commissioning preflight --drive") in shown(operator)


def test_preflight_is_told_with_all_its_sentences_on_demand(operator, opener):
    status = operator.window.header.status
    operator.wait(lambda: "Ready" in status.text())
    opener.spoil_with(preflight=PreflightReport(), steady_s=500.0)
    operator.wait(lambda: "? Preflight Never made since the robot was started. Make it on the robot: rosrun "
                  "mtr_commissioning preflight --drive" in shown(operator))
    assert not status.preflight.isVisibleTo(status.popup)
    fine = PreflightItem("/imu/data", False, "50 Hz.")
    opener.spoil_with(preflight=PreflightReport(320.0, (fine, fine), 2, 0), steady_s=500.0)
    operator.wait(lambda: "\N{CHECK MARK} Preflight 2 of 2 right, 3 min ago." in shown(operator))
    full = PreflightItem("disk", True, "Full {0}.")
    opener.spoil_with(preflight=PreflightReport(320.0, (full, fine), 2, 1), steady_s=500.0)
    operator.wait(lambda: "Not ready" in status.text())
    assert ("\N{MULTIPLICATION X} Preflight 1 of 2 wrong, 3 min ago. disk: Full {0}. Then make it again on the robot: "
            "rosrun mtr_commissioning preflight") in shown(operator)
    assert status.toolTip() == "The robot's preflight found: disk: Full {0}."
    operator.click(status)
    assert not status.preflight.sentences.isVisible()
    operator.click(status.preflight.button)
    assert status.preflight.sentences.isVisible()
    assert status.preflight.sentences.text().splitlines() == [
        "\N{MULTIPLICATION X}  disk: Full {0}.", "\N{CHECK MARK}  /imu/data: 50 Hz."]
    status.popup.hide()


def test_clock_of_the_robot_that_is_apart_is_noted_and_hinders_no_test(operator, opener):
    operator.wait(lambda: "? Robot's clock The robot tells simulated time." in shown(operator))
    opener.spoil_with(sent_s=time.time() - 7200.5, steady_s=5.0)
    # The newest of the simulated clock are counted no more.
    operator.wait(lambda: any(text.startswith("! Robot's clock The robot's clock is 2 h 0 min behind this laptop's: ")
                              for text in shown(operator)))
    assert "Ready" in operator.window.header.status.text()


def shown(operator):
    status = operator.window.header.status
    operator.click(status)
    texts = status.checklist.texts()
    status.popup.hide()
    return texts


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


def test_shield_tells_whether_the_link_is_encrypted_and_is_no_padlock__B15(qtbot):
    link = LinkSymbol(Appearance())
    qtbot.addWidget(link)
    assert link.toolTip() == "The link to the robot is not encrypted."
    link.show_secret(True)
    assert link.toolTip() == "The link to the robot is encrypted."
    link.show_secret(False, True)
    assert link.toolTip().startswith("The link is not encrypted: whoever") and link.accessibleName() == link.toolTip()


@pytest.mark.parametrize(("locks", "is_stale", "text"), [
    (LockState.LOCKED, False, "The Car is locked."), (LockState.UNLOCKED, False, "The Car is unlocked."),
    (LockState.UNLOCKED, True, "Whether the Car is locked is not known."),
    (LockState.UNKNOWN, False, "Whether the Car is locked is not known.")])
def test_padlock_is_that_of_the_car__B15(qtbot, locks, is_stale, text):
    symbol = LocksSymbol(Appearance())
    qtbot.addWidget(symbol)
    symbol.show_locks(locks, is_stale)
    assert symbol.accessibleName() == text
    assert symbol.toolTip().startswith(text)


def test_header_of_a_silent_robot_shows_the_age_of_what_it_said__B1(operator, opener):
    header = operator.window.header
    opener.spoil_with(battery_percent=63, notifications=(LOW,))
    operator.wait(lambda: header.battery.toolTip().endswith("63 %") and header.warning.isVisible())
    operator.wait(lambda: header.locks.accessibleName() == "The Car is locked.")
    opener.is_silent = True
    operator.wait(lambda: header.battery.toolTip().endswith(" s ago)"))
    assert header.battery.toolTip().startswith("Battery of the robot: 63 % (")
    assert header.warning.toolTip().startswith("The robot said ")
    assert header.locks.accessibleName() == "Whether the Car is locked is not known."
    opener.is_silent = False
    operator.wait(lambda: header.battery.toolTip() == "Battery of the robot: 63 %")
    assert header.warning.toolTip() == LOW.text
