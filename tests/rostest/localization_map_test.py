#!/usr/bin/env python3
"""Localization maps on order, says when it sees nothing any more, and leaves the map to another SLAM when told so."""
# SPDX-License-Identifier: Apache-2.0
import math
import sys
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from node_process import NodeProcess
from rosgraph_msgs.msg import Log
from scripted_time import NS, STEP_NS, Listener, ScriptedTime, Speaker, wait_for, wait_for_subscriptions
from scripted_yard import START, YardRobot
from tf2_msgs.msg import TFMessage

from mtr_core import names, schedule
from mtr_core.lockstep.clock import stamp_of
from mtr_msgs.msg import LocalizedPose, MappingOrder, SurfaceMap

STANDSTILL_S = 1.7
SPEED_MPS = 0.8
FULL_TURN_RAD = 2.0 * math.pi
# Without a scan for 0.3 s the pose is degenerate; a sweep and a tick later it has been said.
SILENCE_S = 0.36
OCCUPIED = 65
# A gyro's message that is under way for so long comes when the wheels' of its tick waits for it.
GYRO_LATE_WALL_S = 0.02
# Where another SLAM puts odom.
OTHER_X_M, OTHER_HEADING_RAD = 5.0, 0.5


class Collector:
    """Every message of a topic."""

    def __init__(self, topic, message_type):
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, message_type, self.messages.append, queue_size=100)


class LocalizationMap(unittest.TestCase):
    """Each test begins with a localization that stands in the yard and knows the gyro's bias."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("localization_map_test", disable_rostime=True)
        cls.robot = YardRobot()
        cls.order = Speaker(names.MAPPING_ORDER, MappingOrder(), schedule.CAR_LOCATOR)
        cls.pose = Listener(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION)
        cls.surfaces, cls.grids = Collector(names.SURFACE_MAP, SurfaceMap), Collector(names.MAP_GRID, OccupancyGrid)
        cls.transforms, cls.log = Collector("/tf", TFMessage), Collector("/rosout", Log)
        cls.others = tf2_ros.TransformBroadcaster()
        cls.time = ScriptedTime([], [*cls.robot.speakers, cls.order], [cls.pose])

    def begin(self, **parameters):
        """Start a localization and stand still until its pose is valid or it says why not."""
        self.node = NodeProcess("mtr_localization", "localization_node", "localization", rear_lidar=False, **parameters)
        self.robot.pose, self.robot.lidar.is_silent = START, False
        self.robot.lidar.message.header.frame_id = names.FRONT_LIDAR
        self.order.message = MappingOrder()
        for collector in (self.surfaces, self.grids, self.transforms, self.log):
            collector.messages.clear()
        self.robot.drive(0.0, 0.0)
        wait_for_subscriptions("/localization", (names.IMU_DATA, names.WHEEL_ODOMETRY))
        self.time.start()
        self.advance(STANDSTILL_S)

    def tearDown(self):
        self.node.stop()
        wait_for(lambda: not self.pose.is_connected(), "the end of localization")

    def advance(self, duration_s, speed_mps=0.0, turn_radps=0.0):
        """Let time pass; the newest pose."""
        for _ in range(round(duration_s / (STEP_NS * NS))):
            self.robot.drive(speed_mps, turn_radps)
            newest = self.pose.at(self.time.advance())
        return newest

    def command(self, phase):
        """What the Car locator orders from now on."""
        self.order.message.map_car_id, self.order.message.phase = 1, phase

    def drive_round(self, share):
        """Map on a share of the way round the Car; the newest pose."""
        self.command(MappingOrder.COLLECT)
        self.advance(1.0)
        turn_radps = SPEED_MPS / abs(START.y)
        return self.advance(share * FULL_TURN_RAD / turn_radps, SPEED_MPS, turn_radps)

    def drive_round_and_freeze(self):
        """One way round the Car, and standstill until the map is in force; the newest pose."""
        self.drive_round(1.05)
        self.command(MappingOrder.FREEZE)
        return self.advance(3.0)

    def test_mapping_order_gives_surfaces_key_frames_and_grid_and_a_pose_in_them(self):
        self.begin()
        pose = self.drive_round_and_freeze()
        self.assertTrue(pose.valid, pose.message)
        self.assertEqual((pose.mode, pose.map_revision), (LocalizedPose.LOCALIZED, 1))
        true = START.inverse() @ self.robot.pose
        self.assertLess(math.hypot(pose.x - true.x, pose.y - true.y), 0.01)
        wait_for(lambda: self.surfaces.messages and self.grids.messages, "the map")
        surfaces, grid = self.surfaces.messages[-1], self.grids.messages[-1]
        self.assertTrue(surfaces.valid, surfaces.message)
        self.assertEqual((surfaces.map_car_id, surfaces.revision), (1, 1))
        self.assertGreater(len(surfaces.x), 40)
        self.assertGreater(len(surfaces.key_frames), 30)
        self.assertGreater(np.count_nonzero(np.array(grid.data) >= OCCUPIED), 100)

    def test_silent_lidar_makes_the_pose_degenerate_in_time(self):
        self.begin()
        # Where the robot begins, two parallel sides leave the direction along them free.
        self.assertFalse(self.drive_round(0.15).degenerate)
        self.robot.lidar.is_silent = True
        self.assertTrue(self.advance(SILENCE_S).degenerate)
        self.robot.lidar.is_silent = False
        self.assertFalse(self.advance(0.2).degenerate)

    def test_scan_of_an_unknown_frame_is_told_once_and_the_node_goes_on(self):
        self.begin()
        self.command(MappingOrder.COLLECT)
        self.robot.lidar.message.header.frame_id = "nowhere"
        pose = self.advance(1.0)
        self.assertTrue(pose.valid, pose.message)
        self.assertTrue(pose.degenerate)
        wait_for(lambda: self._said("'nowhere'"), "the sentence")
        self.assertEqual(len(self._said("'nowhere'")), 1)
        self.robot.lidar.message.header.frame_id = names.FRONT_LIDAR
        self.assertFalse(self.advance(0.3).degenerate)

    def test_work_that_a_gyro_message_lets_begin_counts_in_the_load_figures(self):
        figures = Collector("/diagnostics", DiagnosticArray)
        self.robot.gyro.under_way_wall_s = GYRO_LATE_WALL_S
        self.addCleanup(self.robot.gyro.arrive)
        self.begin()
        self.command(MappingOrder.COLLECT)
        self.advance(1.0)
        wait_for(lambda: self._figure(figures, "scans_used") > 10.0, "used scans in the diagnostics")
        self.assertGreater(self._figure(figures, "ms_per_scan"), 0.0)
        self.assertGreaterEqual(self._figure(figures, "longest_answer_ms"), self._figure(figures, "ms_per_scan"))

    def test_robot_without_the_rear_lidar_that_it_shall_have_does_not_start(self):
        self.node = NodeProcess("mtr_localization", "localization_node", "localization", rear_lidar=True)
        self.assertEqual(self.node.exit_status(), 2)

    def test_with_external_the_pose_follows_the_others_transform_and_the_map_is_left_to_them(self):
        self.begin(pose_source="external")
        self.assertIn("Waiting for map to odom", self.advance(0.04).message)
        for _ in range(10):
            self._say_other()
            pose = self.advance(0.1)
        self.assertTrue(pose.valid, pose.message)
        self.assertAlmostEqual(pose.x, OTHER_X_M, places=3)
        self.assertAlmostEqual(pose.heading, OTHER_HEADING_RAD, places=3)
        own = [each for message in self.transforms.messages for each in message.transforms
               if message._connection_header["callerid"] == "/localization"]
        self.assertEqual({each.child_frame_id for each in own}, {names.BASE})
        self.assertFalse(self.grids.messages)
        self.assertFalse(self.advance(1.5).valid)

    def _say_other(self):
        other = TransformStamped(child_frame_id=names.ODOM)
        other.header.frame_id, other.header.stamp = names.MAP, stamp_of(self.time.tick_ns)
        other.transform.translation.x = OTHER_X_M
        other.transform.rotation.z = math.sin(0.5 * OTHER_HEADING_RAD)
        other.transform.rotation.w = math.cos(0.5 * OTHER_HEADING_RAD)
        self.others.sendTransform(other)

    @staticmethod
    def _figure(figures, key):
        """The newest one; -1 before the first."""
        return next((float(pair.value) for message in reversed(figures.messages) for pair in message.status[0].values
                     if pair.key == key), -1.0)

    def _said(self, text):
        return [each for each in self.log.messages if text in each.msg]


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "localization_map_test", LocalizationMap, sys.argv)
