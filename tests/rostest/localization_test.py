#!/usr/bin/env python3
"""Localization says in time that a sensor is silent, and its pose never jumps."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from node_process import NodeProcess
from scripted_time import NS, STEP_NS, Listener, ScriptedTime, Speaker, wait_for, wait_for_subscriptions
from sensor_msgs.msg import Imu, NavSatFix

from mtr_core import names, schedule
from mtr_core.lockstep.publishers import direct_publisher
from mtr_msgs.msg import LocalizedPose

SLOW_READER = pathlib.Path(__file__).resolve().parent / "slow_reader.c"
# Parameters of mtr_localization: gap_limit_s; standstill_settling_s and bias_time_s together.
GAP_LIMIT_NS = 200_000_000
STANDSTILL_S = 1.5
SPEED_MPS = 0.5
BIAS_RADPS = 0.002
# In 20 ms at that speed, with room for rounding.
LARGEST_STEP_M = 0.011


class Robot:
    """Wheels and gyro of a robot that drives straight ahead."""

    def __init__(self):
        self.wheels = Speaker(names.WHEEL_ODOMETRY, Odometry(), schedule.SENSORS)
        self.gyro = Speaker(names.IMU_DATA, Imu(), schedule.SENSORS)
        self.wheels.message.pose.pose.orientation.w = 1.0
        self.gyro.message.angular_velocity.z = BIAS_RADPS

    def drive(self, speed_mps):
        """Speed from the next tick on."""
        self.wheels.message.twist.twist.linear.x = speed_mps

    @property
    def spoken(self):
        """Messages of both so far."""
        return self.wheels.spoken + self.gyro.spoken

    def move(self):
        """One tick of motion, whether anybody hears of it or not."""
        message = self.wheels.message
        message.pose.pose.position.x += message.twist.twist.linear.x * STEP_NS * NS


def messages_read_by(node):
    """Messages of wheels and gyro that a node has taken from its connections."""
    master = rosgraph.Master(rospy.get_name())
    _, subscribed = xmlrpc.client.ServerProxy(master.lookupNode(node)).getBusStats(rospy.get_name())
    return sum(connection[2] for topic, connections in subscribed if topic in (names.IMU_DATA, names.WHEEL_ODOMETRY)
               for connection in connections)


class Localization(unittest.TestCase):
    """Each test begins with a localization that tracks a robot that moves."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("localization_test", disable_rostime=True)
        cls.robot = Robot()
        cls.pose = Listener(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION)
        cls.time = ScriptedTime([], [cls.robot.gyro, cls.robot.wheels], [cls.pose])

    def setUp(self):
        self.begin()

    def begin(self, **variables):
        """Start localization, and go on until the robot moves. variables: of its environment."""
        self.node = NodeProcess("mtr_localization", "localization_node", "localization", variables=variables,
                                rear_lidar=False)
        # Also when the set-up fails: two nodes of one name end each other.
        self.addCleanup(self.end)
        self.heard = []
        self.robot.gyro.is_silent = self.robot.wheels.is_silent = False
        self.robot.drive(0.0)
        wait_for_subscriptions("/localization", (names.IMU_DATA, names.WHEEL_ODOMETRY))
        self.time.start()
        self.advance(STANDSTILL_S + 0.2)
        self.robot.drive(SPEED_MPS)
        self.advance(1.0)
        self.assertTrue(self.heard[-1].valid, self.heard[-1].message)

    def end(self):
        """End localization."""
        self.node.stop()
        wait_for(lambda: not self.pose.is_connected(), "the end of localization")

    def advance(self, duration_s, lag_ns=0):
        """Let time pass, each tick answered by a pose; lag_ns: it answers what it has waited for so long."""
        for _ in range(round(duration_s / (STEP_NS * NS))):
            self.robot.move()
            self.heard.append(self.pose.at(self.time.advance() - lag_ns))

    def advance_unanswered(self):
        """Let the time pass for which localization waits for data, and no faster than it reads what comes."""
        # All that was said before has been answered.
        unread = messages_read_by("/localization") - self.robot.spoken
        for _ in range(GAP_LIMIT_NS // STEP_NS):
            self.robot.move()
            self.time.advance()
            wait_for(lambda: messages_read_by("/localization") >= unread + self.robot.spoken, "reading in localization")

    def assert_no_jump(self):
        """No pose lies farther from the one before than the robot can drive."""
        for before, after in zip(self.heard, self.heard[1:]):
            self.assertLessEqual(math.hypot(after.x - before.x, after.y - before.y), LARGEST_STEP_M)

    def test_silent_wheel_odometry_is_told_in_time_and_loses_the_pose_without_a_jump(self):
        frozen = self.heard[-1]
        self.robot.wheels.is_silent = True
        self.advance_unanswered()
        self.advance(0.3)
        self.assertFalse(any(pose.valid for pose in self.heard[-15:]))
        self.assertIn("odometry is silent", self.heard[-1].message)
        self.robot.wheels.is_silent = False
        self.advance(1.0)
        self.assertIn("Position lost", self.heard[-1].message)
        self.assertEqual((self.heard[-1].x, self.heard[-1].y), (frozen.x, frozen.y))
        self.assert_no_jump()

    def test_silent_imu_is_told_in_time_and_loses_the_pose_without_a_jump(self):
        frozen = self.heard[-1]
        self.robot.gyro.is_silent = True
        self.advance_unanswered()
        self.advance(0.3, lag_ns=GAP_LIMIT_NS + STEP_NS)
        self.assertFalse(any(pose.valid for pose in self.heard[-14:]))
        self.assertEqual(self.heard[-1].message, "The IMU is silent.")
        self.robot.gyro.is_silent = False
        self.advance(1.0)
        self.assertIn("Position lost", self.heard[-1].message)
        self.assertEqual((self.heard[-1].x, self.heard[-1].y), (frozen.x, frozen.y))
        self.assert_no_jump()

    def test_silence_at_standstill_is_over_after_another_standstill(self):
        self.robot.drive(0.0)
        self.advance(1.0)
        before = self.heard[-1]
        self.robot.wheels.is_silent = True
        self.advance_unanswered()
        self.advance(0.3)
        self.assertFalse(self.heard[-1].valid)
        self.robot.wheels.is_silent = False
        self.advance(STANDSTILL_S + 0.2)
        self.assertTrue(self.heard[-1].valid, self.heard[-1].message)
        self.assertAlmostEqual(self.heard[-1].x, before.x, places=6)
        self.assert_no_jump()

    def begin_without_lockstep(self, **variables):
        """Start localization again, with a clock that waits for nobody."""
        self.end()
        rospy.set_param("/lockstep", False)
        self.addCleanup(rospy.set_param, "/lockstep", True)
        self.begin(**variables)

    def test_node_that_is_woken_late_calls_nobody_silent_who_has_spoken(self):
        self.begin_without_lockstep()
        self.assert_answers_what_was_said_while_it_stood()

    def test_node_that_reads_slowly_calls_nobody_silent_whose_messages_have_arrived(self):
        # The connection of the wheels is ready first, and the node reads it to its end before that of the IMU.
        self.time.speakers.reverse()
        self.addCleanup(self.time.speakers.reverse)
        with tempfile.TemporaryDirectory() as folder:
            library = pathlib.Path(folder) / "slow_reader.so"
            subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, SLOW_READER, "-ldl"], check=True)
            self.begin_without_lockstep(LD_PRELOAD=str(library))
            self.assert_answers_what_was_said_while_it_stood()

    def assert_answers_what_was_said_while_it_stood(self):
        """Stop the node's process for twice the gap limit; then each pose of that time is valid."""
        self.node.signal(signal.SIGSTOP)
        begun_ns, steps = self.time.tick_ns, 2 * GAP_LIMIT_NS // STEP_NS
        try:
            for _ in range(steps):
                self.robot.move()
                self.time.advance()
        finally:
            self.node.signal(signal.SIGCONT)
        late = [self.pose.at(begun_ns + step * STEP_NS) for step in range(1, steps + 1)]
        self.heard += late
        self.advance(0.3)
        self.assertEqual([pose.message for pose in late if not pose.valid], [])
        self.assertEqual([pose.header.stamp.to_nsec() - begun_ns for pose in late],
                         [step * STEP_NS for step in range(1, len(late) + 1)])
        self.assertTrue(self.heard[-1].valid, self.heard[-1].message)
        self.assert_no_jump()

    def test_short_gap_is_bridged(self):
        before = self.heard[-1]
        self.robot.wheels.is_silent = True
        for _ in range(5):
            self.robot.move()
            self.time.advance()
        self.robot.wheels.is_silent = False
        self.advance(0.1)
        self.assertTrue(self.heard[-1].valid)
        self.assertAlmostEqual(self.heard[-1].x - before.x, 0.2 * SPEED_MPS, places=3)

    def test_satellite_fixes_that_are_none_are_refused_and_the_pose_goes_on(self):
        refused = []
        figures = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda array: refused.extend(
            float(pair.value) for pair in array.status[0].values if pair.key == "navsat_fixes_refused"))
        fixes = direct_publisher(names.NAVSAT_FIX, NavSatFix)
        wait_for(lambda: fixes.get_num_connections() and figures.get_num_connections(), "localization's connections")
        for frame in ("nowhere", names.BASE):
            fix = NavSatFix(latitude=math.nan, position_covariance_type=NavSatFix.COVARIANCE_TYPE_KNOWN)
            fix.header.frame_id = frame
            fixes.publish(fix)
        self.advance(5.0)
        wait_for(lambda: 1.0 in refused, "one refused fix in the diagnostics")
        self.assertTrue(self.heard[-1].valid, self.heard[-1].message)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "localization_test", Localization, sys.argv)
