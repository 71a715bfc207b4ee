#!/usr/bin/env python3
"""The emergency stop outlives the processes that know of it, on the machine's own clock."""
# SPDX-License-Identifier: Apache-2.0
import signal
import sys
import time
import unittest

import rospy
import rostest
from live_robot import CRUISE_MPS, LiveRobot, wait_until
from node_process import NodeProcess
from scripted_time import Speaker
from sensor_msgs.msg import Joy

from mtr_core import names, schedule

AXES, BUTTONS = 8, 12
E_STOP_BUTTON, RELEASE_BUTTONS = 1, (8, 9)
OWNERS = ["dispatcher", "state_machine", "controller_input"]
# What a robot that is not locked needs to set off, with some room; a lock holds for longer.
SETS_OFF_WITHIN_S = 2.5
STANDS_WITHIN_S = 1.5


class EmergencyStop(unittest.TestCase):
    """Each test begins with the stop released and the planner driving."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("emergency_stop_test")
        cls.robot = LiveRobot()
        cls.joystick = Speaker(names.JOY, Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS), schedule.CONTROLLER_INPUT)
        cls.robot.speakers.append(cls.joystick)
        cls.robot.planner.message.linear_mps, cls.robot.planner.message.active = CRUISE_MPS, True
        cls.robot.start()

    @classmethod
    def tearDownClass(cls):
        cls.robot.close()

    def setUp(self):
        rospy.set_param("/drive_control/lock_owners", OWNERS)
        self.drive = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        self.controller = self.start_controller()
        self.assert_stays_at_rest()
        self.hold(*RELEASE_BUTTONS)
        self.assert_drives()
        self.hold()

    def tearDown(self):
        self.controller.stop()
        self.drive.stop()

    @staticmethod
    def start_controller():
        """A new process of the manual controller's node."""
        return NodeProcess("mtr_controller_input", "controller_input_node", "controller_input")

    def hold(self, *buttons):
        """Hold these buttons and no other."""
        self.joystick.message.buttons = [int(index in buttons) for index in range(BUTTONS)]

    def assert_drives(self):
        """The robot sets off, or goes on."""
        wait_until(lambda: self.robot.speed_mps > CRUISE_MPS / 2.0, "driving")

    def assert_stays_at_rest(self):
        """The robot stands soon, and then for longer than it would take to set off."""
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill", STANDS_WITHIN_S)
        count = len(self.robot.commands)
        time.sleep(SETS_OFF_WITHIN_S)
        self.assertEqual([speed for _, speed in self.robot.commands[count:] if speed], [])

    def press(self):
        """Press the emergency stop and let it go."""
        self.hold(E_STOP_BUTTON)
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill", STANDS_WITHIN_S)
        self.hold()

    def test_stop_that_was_pressed_outlives_the_manual_controllers_process(self):  # A4
        self.press()
        self.controller.signal(signal.SIGKILL)
        self.controller.exit_status()
        self.assert_stays_at_rest()
        self.controller = self.start_controller()
        self.assert_stays_at_rest()
        self.hold(*RELEASE_BUTTONS)
        self.assert_drives()
        self.hold()

    def test_drive_control_that_starts_anew_without_the_manual_controller_stands(self):  # A4
        self.controller.signal(signal.SIGKILL)
        self.drive.signal(signal.SIGKILL)
        self.drive.exit_status()
        self.drive = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        self.assert_stays_at_rest()

    def test_stop_that_was_pressed_outlives_drive_controls_process(self):  # A4
        self.press()
        self.drive.signal(signal.SIGKILL)
        self.drive.exit_status()
        self.drive = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        self.assert_stays_at_rest()


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "emergency_stop_test", EmergencyStop, sys.argv)
