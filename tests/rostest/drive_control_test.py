#!/usr/bin/env python3
"""Drive control stands still for every reason of docs/robot-motion.md, within the times stated there."""
# SPDX-License-Identifier: Apache-2.0
import math
import sys
import unittest

import rospy
import rostest
from case import case
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Log
from scripted_sensors import BEAMS, FAR_M, open_ground
from scripted_time import NS, Listener, ScriptedTime, Speaker, wait_for

from mtr_core import names, schedule
from mtr_msgs.msg import DriveStatus, MotionLock, RobotMode, VelocityCommand

PLANNER_SILENT_S = 0.14
LOCK_SILENT_S = 0.25
SENSOR_SILENT_S = 0.14
ONE_TICK_S = 0.1
# See mtr_drive_control/motion_watch.hpp.
FROZEN_SEEN_S = 0.7
# The accelerometer alone shows 10 deg, which its filter passes on within this; a gyro would show it at once.
TILT_SEEN_S = 3.0
# From any permitted velocity, see mtr_drive_control/parameters.hpp.
STANDSTILL_WITHIN_S = 0.5
TICK_S = 0.02
# Where a person stands who walks up and down before the robot, one step of 10 cm each half second, and half its width.
STEPS_M = (0.2, 0.3, 0.4, 0.5, 0.6, 0.5, 0.4, 0.3)
STEP_S = 0.5
PERSON_RAD = 0.3


class DriveControl(unittest.TestCase):
    """Each test begins with the planner driving at 0.5 m/s."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("drive_control_test", disable_rostime=True)
        cls.planner = Speaker(names.PLANNER_VELOCITY, VelocityCommand(), schedule.MOTION_PLANNER)
        cls.manual = Speaker(names.MANUAL_VELOCITY, VelocityCommand(), schedule.CONTROLLER_INPUT)
        cls.dispatcher = Speaker(names.MOTION_LOCK, MotionLock(owner="dispatcher"), schedule.DISPATCHER)
        cls.state_machine = Speaker(names.MOTION_LOCK, MotionLock(owner="state_machine"), schedule.STATE_MACHINE)
        cls.mode = Speaker(names.ROBOT_MODE, RobotMode(), schedule.STATE_MACHINE)
        cls.front, cls.rear, cls.odometry, cls.imu, cls.peripherals = open_ground()
        cls.speakers = (cls.planner, cls.manual, cls.dispatcher, cls.state_machine, cls.mode, cls.front, cls.rear,
                        cls.odometry, cls.imu, cls.peripherals)
        cls.drive = Listener(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL)
        cls.time = ScriptedTime(["/drive_control"], cls.speakers, [cls.drive])
        cls.wheels = []
        cls.subscriber = rospy.Subscriber(names.WHEEL_COMMAND, Twist, cls.take_wheels, tcp_nodelay=True)
        cls.time.start()

    @classmethod
    def take_wheels(cls, message):
        cls.wheels.append(message)
        cls.odometry.obey(message)
        cls.time.holds.count(message)

    def setUp(self):
        for speaker in self.speakers:
            speaker.is_silent = False
        self.planner.message = VelocityCommand(linear_mps=0.5, active=True)
        self.manual.message = VelocityCommand(active=False)
        self.mode.message.max_speed_mps = 1.0
        self.front.message.ranges = [FAR_M] * BEAMS
        for lock in (self.dispatcher.message, self.state_machine.message):
            lock.engaged, lock.reason = False, ""
        self.time.advance_until(lambda: self.status().linear_mps == 0.5, within_s=3.0)
        self.wheels.clear()

    def status(self):
        """Drive control's word on the present tick."""
        return self.drive.at(self.time.tick_ns)

    def is_standing(self):
        """True when zero is sent to the wheels."""
        status = self.status()
        return status.linear_mps == 0.0 and status.angular_radps == 0.0

    def silence(self, speaker, period_s):
        """Silence a speaker; returns the simulated time at which its next word would have been due."""
        speaker.is_silent = True
        return speaker.heard_ns * NS + period_s

    def assert_noticed(self, condition, since_s, within_s):
        """The condition holds soon enough, and the robot stands soon after."""
        self.time.advance_until(condition, within_s=1.0)
        self.assertLessEqual(self.time.tick_ns * NS - since_s, within_s + 1e-9)
        self.time.advance_until(self.is_standing, within_s=STANDSTILL_WITHIN_S)

    def test_silent_planner_stops_the_robot_in_time(self):
        since_s = self.silence(self.planner, 0.04)
        self.assert_noticed(lambda: self.status().source == "none", since_s, PLANNER_SILENT_S)
        self.assertIn("planner is silent", self.status().message)
        self.time.advance_for(1.0)
        self.assertTrue(self.is_standing())

    def test_silent_dispatcher_stops_the_robot_in_time(self):
        since_s = self.silence(self.dispatcher, 0.1)
        self.assert_noticed(lambda: self.status().source == "locked", since_s, LOCK_SILENT_S)
        self.assertEqual(self.status().engaged_locks, ["dispatcher"])

    def test_silent_state_machine_stops_the_robot_in_time(self):
        since_s = self.silence(self.state_machine, 0.1)
        self.assert_noticed(lambda: self.status().source == "locked", since_s, LOCK_SILENT_S)
        self.assertEqual(self.status().engaged_locks, ["state_machine"])

    def test_engaged_lock_stops_the_robot_at_the_next_tick_of_its_owner(self):
        self.dispatcher.message.engaged, self.dispatcher.message.reason = True, "The Operator stopped the robot."
        since_s = self.time.tick_ns * NS
        self.assert_noticed(lambda: self.status().source == "locked", since_s, ONE_TICK_S + TICK_S)
        self.assertEqual(self.status().message, "The Operator stopped the robot.")

    def test_released_lock_lets_the_robot_go_on(self):
        self.state_machine.message.engaged = True
        self.time.advance_until(self.is_standing, within_s=1.0)
        self.state_machine.message.engaged = False
        self.time.advance_until(lambda: self.status().source == "planner", within_s=0.2)

    def test_silent_lidar_stops_the_robot_in_time(self):
        since_s = self.silence(self.rear, 0.04)
        self.assert_noticed(lambda: self.status().zone == DriveStatus.BLIND, since_s, SENSOR_SILENT_S)
        self.assertEqual(self.status().message, "The rear LiDAR is silent.")

    def test_silent_odometry_stops_the_robot_in_time(self):
        since_s = self.silence(self.odometry, 0.02)
        self.assert_noticed(lambda: self.status().zone == DriveStatus.BLIND, since_s, SENSOR_SILENT_S)

    def test_frozen_odometry_stops_the_robot_until_nobody_has_wanted_to_move_for_a_while(self):  # A7
        self.odometry.is_frozen = True
        stops = self.status().lock_stops
        self.time.advance_until(lambda: self.status().source == "locked", within_s=FROZEN_SEEN_S)
        self.assertIn("odometry is frozen", self.status().message)
        self.assertEqual(self.status().engaged_locks, ["drive_control"])
        self.assertEqual(self.status().lock_stops, stops + 1)
        self.time.advance_until(self.is_standing, within_s=STANDSTILL_WITHIN_S)
        self.odometry.is_frozen = False
        self.time.advance_for(3.0)
        self.assertTrue(self.is_standing())
        self.planner.message = VelocityCommand(active=False)
        self.time.advance_for(1.5)

    def test_frozen_or_silent_imu_stops_the_robot(self):  # A7
        for fault, sentence in (("is_frozen", "The IMU is frozen"), ("is_silent", "The IMU is silent")):
            with case(sentence):
                setattr(self.imu, fault, True)
                self.time.advance_until(lambda: self.status().source == "locked", within_s=FROZEN_SEEN_S)
                self.assertIn(sentence, self.status().message)
                self.time.advance_until(self.is_standing, within_s=STANDSTILL_WITHIN_S)
                setattr(self.imu, fault, False)
                self.planner.message = VelocityCommand(active=False)
                self.time.advance_for(1.5)
                self.setUp()

    def test_robot_that_tilts_stops_until_it_is_level(self):  # H14
        self.imu.pitch_rad = math.radians(10.0)
        self.time.advance_until(lambda: self.status().zone == DriveStatus.BLOCKED, within_s=TILT_SEEN_S)
        self.assertIn("The robot is tilted by", self.status().message)
        self.time.advance_until(self.is_standing, within_s=STANDSTILL_WITHIN_S)
        self.assertEqual(self.status().problems[0].code, "drive_control.tilted")
        self.imu.pitch_rad = 0.0
        self.time.advance_for(3.0 * TILT_SEEN_S)
        self.setUp()

    def test_base_that_does_not_obey_stops_the_robot(self):  # A7
        standing = Twist()
        self.odometry.obey, obey = lambda _: None, self.odometry.obey
        self.odometry.message.twist.twist = standing
        self.time.advance_until(lambda: self.status().source == "locked", within_s=2.0)
        self.assertIn("The base does not obey", self.status().message)
        self.odometry.obey = obey
        self.planner.message = VelocityCommand(active=False)
        self.time.advance_for(1.5)

    def test_emergency_stop_that_was_engaged_when_its_owner_died_outlasts_its_restart(self):  # A4
        stop = Speaker(names.MOTION_LOCK, MotionLock(owner="stop", emergency=True, engaged=True), schedule.DISPATCHER)
        self.time.speakers.append(stop)
        self.time.advance_until(self.is_standing, within_s=20.0)
        stop.is_silent = True
        self.time.advance_for(0.5)
        stop.is_silent, stop.message.engaged = False, False
        self.time.advance_for(2.0)
        self.assertTrue(self.is_standing())
        self.assertIn("engage it and release it again", self.status().message)
        stop.message.engaged = True
        self.time.advance_for(0.3)
        stop.message.engaged = False

    def test_lidar_that_speaks_of_another_frame_or_without_beams_stops_the_robot_and_the_node_lives(self):
        for frame, ranges, sentence in (("map", [FAR_M] * BEAMS, "frame 'map'"), (names.FRONT_LIDAR, [], "beams")):
            self.front.message.header.frame_id, self.front.message.ranges = frame, ranges
            self.time.advance_until(self.is_standing, within_s=ONE_TICK_S + STANDSTILL_WITHIN_S)
            self.assertIn(sentence, self.status().message)
            self.front.message.header.frame_id = names.FRONT_LIDAR
            self.setUp()

    def test_wall_ahead_stops_the_robot_with_its_distance_and_it_goes_on_when_the_wall_has_gone(self):
        angles = [self.front.message.angle_min + beam * self.front.message.angle_increment for beam in range(BEAMS)]
        self.front.message.ranges = [0.19 / math.cos(angle) if abs(angle) < 0.8 else FAR_M for angle in angles]
        self.time.advance_until(self.is_standing, within_s=ONE_TICK_S + STANDSTILL_WITHIN_S)
        self.assertEqual(self.status().zone, DriveStatus.BLOCKED)
        self.assertAlmostEqual(self.status().obstacle_m, 0.04, delta=0.005)
        self.assertIn("Blocked by an obstacle", self.status().message)
        self.front.message.ranges = [FAR_M] * BEAMS
        gone_on_s = self.time.advance_until(lambda: not self.is_standing(), within_s=2.0)
        self.assertGreater(gone_on_s, 0.9)

    def test_person_who_walks_up_and_down_before_the_robot_is_one_line_of_the_log(self):
        said, sentences = [], set()
        log = rospy.Subscriber("/rosout", Log, lambda line: said.append((line.level, line.msg)), queue_size=100)
        # This process' own log is one of the two.
        wait_for(lambda: log.get_num_connections() > 1, "drive control's log")
        angles = [self.front.message.angle_min + beam * self.front.message.angle_increment for beam in range(BEAMS)]
        for ahead_m in 3 * STEPS_M:
            self.front.message.ranges = [ahead_m if abs(angle) < PERSON_RAD else FAR_M for angle in angles]
            self.time.advance_for(STEP_S)
            sentences.add(self.status().message)
        self.assertGreaterEqual(len(sentences), len(set(STEPS_M)) - 1, "the status has each distance")
        self.dispatcher.message.engaged, self.dispatcher.message.reason = True, "The Operator stopped the robot."
        self.time.advance_until(lambda: self.status().source == "locked", within_s=ONE_TICK_S + TICK_S)
        wait_for(lambda: any("Operator" in text for _, text in said), "the lock in the log")
        log.unregister()
        blocked = [level for level, text in said if "Blocked by an obstacle" in text]
        self.assertEqual(blocked, [Log.WARN], said)
        self.assertLessEqual(len(said), 3, said)

    def test_velocity_that_is_no_number_stops_the_robot_and_never_reaches_the_wheels(self):
        self.planner.message = VelocityCommand(linear_mps=math.nan, angular_radps=math.inf, active=True)
        self.time.advance_until(self.is_standing, within_s=ONE_TICK_S + STANDSTILL_WITHIN_S)
        self.time.advance_for(0.2)
        self.assertTrue(all(math.isfinite(twist.linear.x) and math.isfinite(twist.angular.z) for twist in self.wheels))
        self.assertIn("not a finite number", self.status().message)

    def test_maximum_speed_of_the_command_holds_and_its_silence_stops_the_robot(self):
        self.mode.message.max_speed_mps = 0.2
        self.time.advance_until(lambda: self.status().linear_mps == 0.2, within_s=0.6)
        self.silence(self.mode, 0.1)
        self.time.advance_until(self.is_standing, within_s=LOCK_SILENT_S + STANDSTILL_WITHIN_S)
        self.assertIn("state machine is silent", self.status().message)

    def test_manual_controller_overrides_the_planner(self):
        self.manual.message = VelocityCommand(linear_mps=-0.2, active=True)
        self.time.advance_until(lambda: self.status().source == "manual", within_s=ONE_TICK_S)
        self.time.advance_until(lambda: self.status().linear_mps == -0.2, within_s=3.0)
        self.manual.message = VelocityCommand(active=False)
        self.time.advance_until(lambda: self.status().source == "planner", within_s=ONE_TICK_S)

    def test_manual_controller_that_falls_silent_does_not_hand_over_to_the_planner(self):
        self.manual.message = VelocityCommand(linear_mps=0.2, active=True)
        self.time.advance_until(lambda: self.status().source == "manual", within_s=ONE_TICK_S)
        since_s = self.silence(self.manual, 0.04)
        self.assert_noticed(lambda: self.status().source == "none", since_s, PLANNER_SILENT_S)
        self.assertIn("manual controller is silent", self.status().message)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "drive_control_test", DriveControl, sys.argv)
