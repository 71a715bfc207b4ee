#!/usr/bin/env python3
"""Peripherals and firmware together: each press happens once, and the key gets where it shall."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
import sys
import tempfile
import unittest

import rospy
import rostest
from node_process import NodeProcess
from scripted_time import NS, Speaker
from sensor_msgs.msg import Joy

from mtr_core import names, schedule
from mtr_core.lockstep import Ticker, TickInput
from mtr_msgs.msg import ButtonPress, DesiredState, DriveStatus, MotionLock, PeripheralsState, RobotMode
from mtr_simulation.truth.log import FILE_NAME

LOCK, UNLOCK = 1, 2
SESSION_ID = 77
HEIGHT_TOLERANCE_M = 0.02
HEIGHT_WITHIN_S = 40.0
PRESS_S = 0.3
# The contact closes before the servo has reached the ordered travel, which is what the firmware reports.
SERVO_TRAVEL_S = 0.1
# Of the manual controller, see mtr_controller_input/parameters.py.
SLOW_BUTTON, LIFT_AXIS, LIFT_MPS = 4, 7, 0.1
RELEASE_BUTTONS, RELEASED_WITHIN_S = (8, 9), 10.0
HELD_S = 1.5


def is_engaged(state):
    """The peripherals say that an emergency stop holds them."""
    return "emergency stop" in state.message


class Peripherals(unittest.TestCase):
    """This test takes part in lock-step in the place of dispatcher and state machine."""

    press_id = 0
    is_released = False

    @classmethod
    def setUpClass(cls):
        rospy.init_node("peripherals_test")
        cls.folder = tempfile.TemporaryDirectory()
        cls.truth = pathlib.Path(cls.folder.name) / FILE_NAME
        # The peripherals wait for no word of the manual controller about the lift, which speaks only while it moves it:
        # at full speed a busy machine would make a short way of it.
        cls.simulator = NodeProcess("mtr_simulation", "simulator_node", "simulator", real_time_factor=2.0,
                                    car_port_link=f"{cls.folder.name}/can", truth_dir=cls.folder.name,
                                    hold_for=["peripherals", "peripherals_test", "controller_input"])
        desired = DesiredState(session_id=SESSION_ID, link_alive=True, key_height_m=0.8)
        cls.desired = Speaker(names.DESIRED_STATE, desired, schedule.DISPATCHER)
        cls.mode = Speaker(names.ROBOT_MODE, RobotMode(mode=RobotMode.FOLLOWING_WAYPOINT), schedule.STATE_MACHINE)
        cls.drive = Speaker(names.DRIVE_STATUS, DriveStatus(), schedule.DRIVE_CONTROL)
        cls.joystick = Speaker(names.JOY, Joy(axes=[0.0] * 8, buttons=[0] * 12), schedule.CONTROLLER_INPUT)
        cls.lock = Speaker(names.MOTION_LOCK, MotionLock(owner="emergency_button", emergency=True), schedule.DISPATCHER)
        cls.peripherals = TickInput(names.PERIPHERALS_STATE, PeripheralsState, schedule.PERIPHERALS)
        cls.ticker = Ticker(schedule.CLOCK_STEP)

    @classmethod
    def tearDownClass(cls):
        cls.simulator.stop()
        cls.folder.cleanup()

    def setUp(self):
        self.desired.message.press = ButtonPress()
        self.desired.message.link_alive = True
        self.advance(0.2)
        if not self.is_released:
            self.release_emergency_stop()

    def release_emergency_stop(self):
        """The manual controller begins with its emergency stop engaged; a person releases it on purpose."""
        for held, is_over in ((0, is_engaged), (1, lambda state: not is_engaged(state)), (0, lambda state: True)):
            for button in RELEASE_BUTTONS:
                self.joystick.message.buttons[button] = held
            self.assertTrue(is_over(self.advance_until(is_over, RELEASED_WITHIN_S)), "the emergency stop")
        Peripherals.is_released = True

    def advance(self, duration_s):
        """Take part for some time; the peripherals' newest state."""
        return self.advance_until(lambda state: False, duration_s)

    def advance_until(self, condition, within_s):
        """Take part until the condition on the peripherals' state holds, or the time is over; the state."""
        state = None
        for _ in range(round(within_s / (schedule.CLOCK_STEP.period_ns * NS))):
            tick_ns = self.ticker.sleep()
            for speaker in (self.desired, self.mode, self.drive, self.joystick, self.lock):
                speaker.speak(tick_ns)
            state = self.peripherals.at(tick_ns)
            if state and condition(state):
                break
        return state

    def order_press(self, button):
        """Order the next press, as a Command repeats it; returns its id."""
        Peripherals.press_id += 1
        self.desired.message.press = ButtonPress(self.press_id, [button], 1.0, PRESS_S)
        return self.press_id

    def true_presses(self):
        """Presses that the simulated Car felt so far."""
        with self.truth.open(newline="") as lines:
            return [row for row in csv.DictReader(lines) if row["event"] == "press"]

    def test_press_is_carried_out_once_though_it_is_ordered_again_and_again(self):
        before = len(self.true_presses())
        press_id = self.order_press(UNLOCK)
        state = self.advance(4.0)
        self.assertEqual([report.id for report in state.presses if report.id == press_id], [press_id])
        self.assertEqual(state.presses[-1].error, "")
        self.assertEqual(len(self.true_presses()), before + 1)

    def test_reported_press_is_the_true_one(self):
        press_id = self.order_press(LOCK)
        state = self.advance_until(lambda state: any(report.id == press_id for report in state.presses), 5.0)
        report = state.presses[-1]
        true_start_s = float(self.true_presses()[-1]["robot_time_s"])
        self.assertAlmostEqual(report.start.to_sec(), true_start_s, delta=SERVO_TRAVEL_S)
        self.assertAlmostEqual((report.end - report.start).to_sec(), PRESS_S, delta=0.05)

    def test_next_id_presses_again(self):
        before = len(self.true_presses())
        for _ in range(2):
            press_id = self.order_press(LOCK)
            self.advance_until(lambda state, press_id=press_id: state.presses and state.presses[-1].id == press_id, 5.0)
        self.assertEqual(len(self.true_presses()), before + 2)

    def test_silent_link_presses_nothing(self):
        before = len(self.true_presses())
        self.desired.message.link_alive = False
        self.order_press(UNLOCK)
        self.advance(2.0)
        self.assertEqual(len(self.true_presses()), before)

    def test_key_reaches_the_ordered_height_and_holds_it(self):
        for height_m in (1.4, 0.7):
            self.desired.message.key_height_m = height_m
            self.advance_until(lambda state, goal_m=height_m: abs(state.key_height_m - goal_m) <= HEIGHT_TOLERANCE_M,
                               HEIGHT_WITHIN_S)
            state = self.advance(5.0)
            self.assertAlmostEqual(state.key_height_m, height_m, delta=HEIGHT_TOLERANCE_M)
            self.order_press(LOCK)
            self.advance(2.0)
            self.assertAlmostEqual(float(self.true_presses()[-1]["key_z_m"]), height_m, delta=HEIGHT_TOLERANCE_M)

    def test_person_moves_the_lift_by_the_manual_controller_and_it_holds_when_released(self):
        self.desired.message.link_alive = False
        before_m = self.advance(1.0).key_height_m
        for way in (1.0, -1.0):
            self.joystick.message.buttons[SLOW_BUTTON], self.joystick.message.axes[LIFT_AXIS] = 1, way
            self.advance(HELD_S)
            self.joystick.message.buttons[SLOW_BUTTON], self.joystick.message.axes[LIFT_AXIS] = 0, 0.0
            there_m = self.advance(1.0).key_height_m
            self.assertAlmostEqual(there_m - before_m, way * LIFT_MPS * HELD_S, delta=0.3 * LIFT_MPS * HELD_S)
            self.assertAlmostEqual(self.advance(1.0).key_height_m, there_m, delta=0.002)
            before_m = there_m

    def test_emergency_stop_holds_the_lift_lets_no_press_begin_and_says_so(self):  # A3
        self.desired.message.key_height_m = 1.5
        self.advance(2.0)
        self.lock.message.engaged, self.lock.message.reason = True, "The button is pressed."
        before = len(self.true_presses())
        held = self.advance(1.0)
        self.order_press(LOCK)
        later = self.advance(2.0)
        self.assertAlmostEqual(later.key_height_m, held.key_height_m, delta=0.002)
        self.assertIn("The button is pressed.", later.message)
        self.assertEqual((later.presses[-1].id, len(self.true_presses())), (self.press_id, before))
        self.assertIn("was not begun", later.presses[-1].error)
        self.lock.message.engaged = False
        self.assertGreater(self.advance(1.0).key_height_m, later.key_height_m + 0.05)
        self.desired.message.key_height_m = 0.8
        self.advance(8.0)

    def test_leds_warn_while_a_robot_without_rear_lidar_drives_backwards(self):
        self.drive.message.linear_mps = -0.2
        self.assertEqual(self.advance(0.5).led, "warning")
        self.drive.message.linear_mps = 0.0
        self.assertNotEqual(self.advance(0.5).led, "warning")

    def test_height_out_of_reach_is_refused_with_a_sentence(self):
        self.desired.message.key_height_m = 5.0
        state = self.advance(1.0)
        self.assertIn("5", state.message)
        self.desired.message.key_height_m = 0.8
        self.assertEqual(self.advance(1.0).message, "")


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "peripherals_test", Peripherals, sys.argv)
