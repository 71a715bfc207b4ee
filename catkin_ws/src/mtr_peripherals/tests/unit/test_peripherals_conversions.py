"""Conversion of ROS messages to the peripherals' plain data and back."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
import rospy

from mtr_core.crc import is_sound
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import Press, PressReport
from mtr_msgs.msg import ButtonPress, DesiredState, FirmwareState, MotionLock, RobotMode, Waypoint
from mtr_peripherals.conversions import (
    battery_charge,
    command_message,
    emergency_word,
    firmware_report,
    inputs_from,
    joint_message,
    press_message,
    state_message,
)
from mtr_peripherals.core import STOPPED, Outcome
from mtr_peripherals.firmware import Led, PressState, ServoPress
from mtr_peripherals.firmware_clock import RobotClock, SharedClock

SECOND_NS = 1_000_000_000
REFUSED = Problem("peripherals.refused", "A sentence.")
STAMP = rospy.Time(5)
OUTCOME = Outcome(False, 0.5, Led.MOVING, ServoPress(3, 2, 0.5, 250, 0), True, 0.4, 0.75, (2,),
                  [PressReport(8, 7, 4 * SECOND_NS, 4 * SECOND_NS + 1, NO_PROBLEM),
                   PressReport(9, 7, 5 * SECOND_NS, 5 * SECOND_NS, REFUSED)], "moving", REFUSED, 4)


def test_leds_are_those_of_the_message():
    assert {led.value for led in Led} == set(range(11))
    command = command_message(OUTCOME, 6, 9)
    assert (command.seq, command.lift_height_m, command.led_pattern) == (6, 0.5, 4)
    assert (command.stop, command.latest_us) == (0, 9)
    assert is_sound(command) and is_sound(press_message(OUTCOME.press, 9))
    assert command_message(STOPPED, 7, 9).stop == 1 and math.isnan(command_message(STOPPED, 7, 9).lift_height_m)


@pytest.mark.parametrize("engaged", [False, True])
def test_lock_of_an_emergency_stop_is_a_word_with_its_reason(engaged):
    word = emergency_word(MotionLock(owner="remote", engaged=engaged, reason="Pressed.", emergency=True), 5)
    assert (word.owner, word.reason.text, word.steady_stamp_ns) == ("remote", "Pressed." if engaged else "", 5)
    assert emergency_word(MotionLock(owner="remote", engaged=True), 5).reason.text, "a lock without a reason is one"


@pytest.mark.parametrize("hold_id, is_held", [(0, False), (7, True)])
def test_hold_of_the_robot_is_one_of_its_lift(hold_id, is_held):
    assert inputs_from(DesiredState(session_id=2), RobotMode(mode=4, hold_id=hold_id)).is_held is is_held


def test_inputs_take_session_height_and_press():
    desired = DesiredState(session_id=7, link_alive=True, key_height_m=1.0, press=ButtonPress(8, [1], 0.5, 0.25))
    found = inputs_from(desired, RobotMode(mode=4, goal=Waypoint(id=1)))
    wanted = found.desired
    assert (wanted.session_id, wanted.link_alive, wanted.stop, wanted.key_height_m) == (7, True, False, 1.0)
    assert wanted.press == Press(8, 7, (1,), 0.5, 0.25)
    assert (found.mode, found.has_goal) == (4, True)


def test_silent_nodes_want_nothing():
    found = inputs_from(None, None).desired
    assert found.stop and not found.link_alive and math.isnan(found.key_height_m) and not found.press.id


def test_firmware_state_gets_the_robots_clock():
    stamp_ns = 100 * SECOND_NS
    state = FirmwareState(time_us=100_000_000, lift_height_m=0.4, press_id=3, press_state=2,
                          press_start_us=99_000_000, press_end_us=99_500_000, led_pattern=4)
    report = firmware_report(state, stamp_ns, SharedClock())
    assert report.press_state is PressState.DONE
    assert (report.press_start_ns, report.press_end_ns) == (99 * SECOND_NS, 99 * SECOND_NS + SECOND_NS // 2)


def test_outcome_becomes_messages():
    robot = RobotClock()
    state, joints = state_message(OUTCOME, 0.9, STAMP, robot, 3), joint_message(OUTCOME, STAMP)
    press = press_message(OUTCOME.press, 9)
    assert (state.alive, state.key_height_m, state.pressed_buttons, state.battery) == (True, 0.75, [2], 0.9)
    assert [(report.session_id, report.id, report.start) for report in state.presses] == [
        (7, 8, rospy.Time(4)), (7, 9, rospy.Time(5))]
    assert [(report.error, [problem.code for problem in report.problems]) for report in state.presses] == [
        ("", []), (REFUSED.text, [REFUSED.code])]
    assert [problem.code for problem in state.problems] == [REFUSED.code]
    assert (state.led, state.message, state.header.stamp) == ("moving", "A sentence.", STAMP)
    assert (press.id, press.servos, press.strength, press.hold_ms, press.latest_us) == (3, 2, 0.5, 250, 9)
    assert (state.manual_lifts, state.firmware_resets) == (4, 3)
    assert joints.name[0] == "lift" and joints.position[0] == 0.4 and len(joints.name) == len(joints.position) == 5


def test_unknown_battery_is_nan():
    assert math.isnan(battery_charge(None)) and math.isnan(battery_charge(math.nan)) and battery_charge(0.5) == 0.5
