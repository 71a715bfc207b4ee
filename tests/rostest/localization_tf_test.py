#!/usr/bin/env python3
"""The base says odom to base_link itself: map to odom is of the base's odom, whoever is first with a correction."""
# SPDX-License-Identifier: Apache-2.0
import math
import sys
import unittest

import rospy
import rostest
from node_process import NodeProcess
from scripted_time import NS, STEP_NS, wait_for, wait_for_subscriptions
from scripted_yard import START, YardRobot
from tf2_msgs.msg import TFMessage

from mtr_core import names
from mtr_core.lockstep.clock import stamp_of

STANDSTILL_S, TURN_S, TURN_RADPS = 2.0, 3.0, 0.5
# Wheels that slip sideways tell more of a turn than there is.
TOLD_TURN = 1.4
# In two messages of the wheels, 0.04 s, their odometry turns 0.008 rad too far.
LARGEST_STEP_RAD = 0.05
# A sweep that ends between two messages of the wheels has a transform of its own.
SCAN_TIME_S = 0.03


class LocalizationTf(unittest.TestCase):
    """Each test starts a localization of its own."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("localization_tf_test")
        cls.robot, cls.headings = YardRobot(), []
        cls._subscriber = rospy.Subscriber("/tf", TFMessage, cls._take, queue_size=1000)

    @classmethod
    def _take(cls, message):
        for each in message.transforms:
            if each.child_frame_id == names.ODOM:
                rotation = each.transform.rotation
                cls.headings.append((each.header.stamp.to_nsec(), 2.0 * math.atan2(rotation.z, rotation.w)))

    def test_map_from_odom_does_not_jump_between_two_odometries(self):
        node = NodeProcess("mtr_localization", "localization_node", "localization", rear_lidar=False,
                           publish_odom_tf=False)
        self.addCleanup(node.stop)
        self.robot.lidar.message.scan_time = SCAN_TIME_S
        wait_for_subscriptions("/localization", (names.IMU_DATA, names.WHEEL_ODOMETRY, names.FRONT_SCAN))
        self.drive(0.0, STANDSTILL_S)
        self.drive(TURN_RADPS, TURN_S)
        wheels_messages = round((STANDSTILL_S + TURN_S) / (STEP_NS * NS))
        wait_for(lambda: len(self.headings) > 1.2 * wheels_messages, "transforms between two messages of the wheels")
        headings = [heading for _, heading in sorted(self.headings)]
        steps = [abs(math.remainder(after - before, 2.0 * math.pi)) for before, after in zip(headings, headings[1:])]
        self.assertLess(max(steps), LARGEST_STEP_RAD)
        # It was a turn in which the two are far apart.
        self.assertGreater(abs(math.remainder(headings[-1] - headings[0], 2.0 * math.pi)), 4.0 * LARGEST_STEP_RAD)

    def test_transform_of_another_program_needs_the_odom_of_localization(self):
        node = NodeProcess("mtr_localization", "localization_node", "localization", rear_lidar=False,
                           pose_source="external", publish_odom_tf=False)
        self.assertEqual(node.exit_status(), 2)

    def drive(self, turn_radps, duration_s):
        """The sensors speak at their rates, by the clock on the wall."""
        begin_ns = (rospy.Time.now().to_nsec() // STEP_NS + 1) * STEP_NS
        for tick_ns in range(begin_ns, begin_ns + round(duration_s / NS), STEP_NS):
            self.robot.drive(0.0, turn_radps)
            turned_rad = TOLD_TURN * (START.inverse() @ self.robot.pose).heading
            orientation = self.robot.wheels.message.pose.pose.orientation
            orientation.z, orientation.w = math.sin(0.5 * turned_rad), math.cos(0.5 * turned_rad)
            rospy.sleep(stamp_of(tick_ns) - rospy.Time.now())
            for speaker in self.robot.speakers:
                speaker.speak(tick_ns)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "localization_tf_test", LocalizationTf, sys.argv)
