#!/usr/bin/env python3
"""A base's emergency stop on a topic of its own stops the wheels, and by drive control's word lift and servos too."""
# SPDX-License-Identifier: Apache-2.0
import sys
import time
import unittest

import rospy
import rostest
from live_robot import CRUISE_MPS, LiveRobot, wait_until
from node_process import NodeProcess
from std_msgs.msg import Bool

from mtr_core import names
from mtr_msgs.msg import MotionLock
from mtr_peripherals.conversions import emergency_word
from mtr_peripherals.emergency import EmergencyStops

TOPIC = "/e_stop"
PRESSED = "The emergency stop is pressed."
PERIPHERALS_SILENT_S = 0.5
# What a robot that is not locked needs to set off, with some room; a lock holds for longer.
SETS_OFF_WITHIN_S = 2.5
STANDS_WITHIN_S = 1.5


class EStop:
    """Says 50 times a second whether it is pressed, unless it is silent."""

    def __init__(self):
        self.is_pressed, self.is_silent = False, True
        self._publisher = rospy.Publisher(TOPIC, Bool, queue_size=10, tcp_nodelay=True)

    def speak(self, _):
        """Say it."""
        if not self.is_silent:
            self._publisher.publish(self.is_pressed)


class EStopTopic(unittest.TestCase):
    """Each test begins with drive control started and nothing heard of the stop; the planner wants to drive."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("e_stop_topic_test")
        rospy.set_param("/drive_control/e_stop_topics", [TOPIC])
        cls.said, cls.stops = [], EmergencyStops((), PERIPHERALS_SILENT_S)
        cls.robot, cls.e_stop = LiveRobot(), EStop()
        cls.robot.speakers.append(cls.e_stop)
        cls.robot.planner.message.linear_mps, cls.robot.planner.message.active = CRUISE_MPS, True
        cls.subscriber = rospy.Subscriber(names.MOTION_LOCK, MotionLock, cls.take_lock, queue_size=50, tcp_nodelay=True)
        cls.robot.start()

    @classmethod
    def take_lock(cls, message):
        """As the peripherals do."""
        if message.owner == TOPIC:
            cls.stops.take(emergency_word(message, time.monotonic_ns()))
            cls.said.append(message)

    @classmethod
    def tearDownClass(cls):
        cls.robot.close()
        rospy.delete_param("/drive_control/e_stop_topics")

    def setUp(self):
        self.e_stop.is_pressed, self.e_stop.is_silent = False, True
        self.said.clear()
        self.drive = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        wait_until(lambda: self.said, "drive control's word on the stop")

    def tearDown(self):
        self.drive.stop()

    def lift_stands(self, why):
        """The peripherals would hold lift and servos for this reason."""
        return why in self.stops.reason(time.monotonic_ns()).text

    def assert_all_stand(self, why):
        """Wheels, lift and servos stand soon, and for longer than it would take to set off."""
        wait_until(lambda: self.lift_stands(why), f"lift that stands: {why}", STANDS_WITHIN_S)
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill", STANDS_WITHIN_S)
        count = len(self.robot.commands)
        time.sleep(SETS_OFF_WITHIN_S)
        self.assertEqual([speed for _, speed in self.robot.commands[count:] if speed], [])
        self.assertTrue(self.lift_stands(why))

    def assert_all_go_on(self):
        """The robot drives, and nothing holds its lift."""
        wait_until(lambda: self.robot.speed_mps > CRUISE_MPS / 2.0, "driving")
        self.assertFalse(self.stops.reason(time.monotonic_ns()))

    def release(self):
        """It is heard, and not pressed."""
        self.e_stop.is_pressed, self.e_stop.is_silent = False, False

    def test_one_that_was_never_heard_is_engaged(self):
        self.assert_all_stand("Waiting for the motion lock of /e_stop.")
        self.assertTrue(self.said[-1].emergency and self.said[-1].engaged)

    def test_pressed_it_stops_all_and_released_all_go_on(self):
        self.release()
        self.assert_all_go_on()
        self.e_stop.is_pressed = True
        self.assert_all_stand(PRESSED)
        self.release()
        self.assert_all_go_on()

    def test_silent_it_stops_all_and_heard_again_all_go_on(self):
        self.release()
        self.assert_all_go_on()
        self.e_stop.is_silent = True
        self.assert_all_stand("The motion lock of /e_stop is silent.")
        self.release()
        self.assert_all_go_on()

    def test_pressed_it_outlasts_its_driver_until_it_is_pressed_and_released(self):  # A4
        self.e_stop.is_pressed, self.e_stop.is_silent = True, False
        self.assert_all_stand(PRESSED)
        self.e_stop.is_silent = True
        self.assert_all_stand("silent")
        self.release()
        self.assert_all_stand("engage it and release it again")
        self.e_stop.is_pressed = True
        self.assert_all_stand(PRESSED)
        self.release()
        self.assert_all_go_on()

    def test_drive_control_that_is_dead_holds_the_lift(self):
        self.release()
        self.assert_all_go_on()
        self.drive.stop()
        self.assert_all_stand("The emergency stop of /e_stop is silent.")


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "e_stop_topic_test", EStopTopic, sys.argv)
