#!/usr/bin/env python3
"""The base guard stops a base that nobody commands any more, within its limits, and brakes before it ends."""
# SPDX-License-Identifier: Apache-2.0
import signal
import sys
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from live_robot import BASE, CRUISE_MPS, PERIOD_S, wait_until
from node_process import NodeProcess

from mtr_core import names
from mtr_description.base_controller import CONTROLLER, base_parameters_in
from mtr_description.shipped import shipped_base_file

HARDEST_STEP_MPS = 1.01 * BASE.linear_acceleration_mps2 * PERIOD_S
STOPS_WITHIN_S = BASE.command_timeout_s + CRUISE_MPS / BASE.linear_acceleration_mps2
# Of a machine that does other things too.
LATE_S = 0.3


class BaseGuard(unittest.TestCase):
    """Each test begins with the base at cruise speed, commanded 50 times a second."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("base_guard_test")
        rospy.set_param(f"{names.BASE_GUARD}/{CONTROLLER}", base_parameters_in(shipped_base_file()))
        cls.commands = rospy.Publisher(names.GUARDED_WHEEL_COMMAND, Twist, queue_size=1, tcp_nodelay=True)
        cls.speeds = []
        cls.wheels = rospy.Subscriber(names.WHEEL_COMMAND, Twist, lambda twist: cls.speeds.append(twist.linear.x))

    def setUp(self):
        self.guard = NodeProcess("mtr_drive_control", "base_guard_node", names.BASE_GUARD.lstrip("/"))
        self.is_over = threading.Event()
        self.thread = threading.Thread(target=self.command, daemon=True)
        self.thread.start()
        wait_until(lambda: self.speeds and self.speeds[-1] == CRUISE_MPS, "cruise speed")

    def tearDown(self):
        self.fall_silent()
        self.guard.stop()
        self.speeds.clear()

    def command(self):
        """Take the place of drive control."""
        twist = Twist()
        twist.linear.x = CRUISE_MPS
        while not self.is_over.wait(PERIOD_S):
            self.commands.publish(twist)

    def fall_silent(self):
        """As drive control does when it is killed."""
        self.is_over.set()
        self.thread.join()

    def assert_ramp(self, speeds):
        """From cruise speed to zero, no harder than the limit."""
        for before_mps, after_mps in zip([CRUISE_MPS, *speeds], speeds):
            self.assertLessEqual(abs(before_mps - after_mps), HARDEST_STEP_MPS)
        self.assertEqual(speeds[-1], 0.0)

    def test_killed_drive_control_is_followed_by_a_ramp_to_zero(self):  # A2
        count = len(self.speeds)
        self.fall_silent()
        wait_until(lambda: self.speeds[-1] == 0.0, "standstill", STOPS_WITHIN_S + LATE_S)
        self.assert_ramp(self.speeds[count:])

    def test_guard_that_is_ended_brakes_first(self):  # A2
        count = len(self.speeds)
        self.guard.signal(signal.SIGTERM)
        self.assertEqual(self.guard.exit_status(), 0)
        time.sleep(LATE_S)
        self.assert_ramp(self.speeds[count:])

    def test_guard_that_was_stalled_begins_from_standstill_as_the_base_does(self):  # A1
        self.guard.signal(signal.SIGSTOP)
        time.sleep(1.0)
        count = len(self.speeds)
        self.guard.signal(signal.SIGCONT)
        wait_until(lambda: self.speeds[-1] == CRUISE_MPS and len(self.speeds) > count + 10, "cruise speed")
        speeds = [0.0, *self.speeds[count:]]
        for before_mps, after_mps in zip(speeds, speeds[1:]):
            self.assertLessEqual(after_mps - before_mps, HARDEST_STEP_MPS)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "base_guard_test", BaseGuard, sys.argv)
