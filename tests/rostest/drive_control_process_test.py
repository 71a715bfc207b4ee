#!/usr/bin/env python3
"""Drive control as a process that is stopped for a while or ended, on the machine's own clock."""
# SPDX-License-Identifier: Apache-2.0
import signal
import sys
import time
import unittest

import rospy
import rostest
from case import case
from geometry_msgs.msg import Twist
from live_robot import BASE, CRUISE_MPS, PERIOD_S, LiveRobot, wait_until
from node_process import NodeProcess
from scripted_time import NS

from mtr_core import names
from mtr_description.base_controller import CONTROLLER
from mtr_msgs.msg import DriveStatus

STALLS_S = (0.3, 0.6, 1.0, 2.0)
# Twists that were under way when the node was stopped arrive within this.
IN_FLIGHT_S = 0.05
# The master is asked once a second.
INTRUDER_SEEN_S = 1.5
# Drive control reads the limits of the base every 5 s.
CHANGE_SEEN_S = 7.0
SAID_WITHIN_S = 1.0
STARTED_WITHIN_S = 20.0
OTHER_COMMAND = "/other_base/cmd_vel"
ACCELERATION_MPS2 = 1.0
STEP_UP_MPS = ACCELERATION_MPS2 * PERIOD_S + 1e-9
# With a low key, see mtr_drive_control/tip_over.hpp; the last step of a stop may take the rounding with it.
HARDEST_MPS2 = 1.01 * 2.4
# Odometry of wheels that brake is that old on a machine that does other things too.
SEEN_LATE_S = 0.06
STANDS_AFTER_S = BASE.command_timeout_s + CRUISE_MPS / BASE.linear_acceleration_mps2


def seen_late_mps(wheels_mps):
    """What wheels that still move have lost since their odometry was said."""
    return BASE.linear_acceleration_mps2 * SEEN_LATE_S if wheels_mps else 0.0


class DriveControlProcess(unittest.TestCase):
    """Each test begins with the planner driving at cruise speed."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("drive_control_process_test")
        cls.robot = LiveRobot()
        cls.robot.start()
        cls.message, cls.decided = "", []
        cls.status = rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, cls.take_status)

    @classmethod
    def take_status(cls, status):
        """What drive control says, and what it has decided when."""
        cls.message = status.message
        cls.decided.append((status.header.stamp.to_nsec(), status.linear_mps))

    @classmethod
    def tearDownClass(cls):
        cls.robot.close()

    def setUp(self):
        self.robot.dispatcher.message.engaged = False
        self.node = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        self.cruise()

    def tearDown(self):
        self.node.stop()

    def cruise(self):
        """The planner drives, and the wheels do it."""
        self.robot.planner.message.linear_mps, self.robot.planner.message.active = CRUISE_MPS, True
        wait_until(lambda: self.robot.commands and self.robot.commands[-1][1] == CRUISE_MPS
                   and abs(self.robot.speed_mps - CRUISE_MPS) < 0.01, "cruise speed")

    def stall(self, duration_s, meanwhile=lambda: None):
        """Stop the process for so long; the wheels' speed when it goes on, and the speeds that it may command then.

        Also what it commands and what it decides in the next half second. A command that was decided before the stop
        and was still to be sent leaves after it, for a Twist has no stamp by which it would be found old; the wheels
        obey it until the next one. It is left out; drive control's status has stamps for decisions after the stop.
        """
        self.node.signal(signal.SIGSTOP)
        time.sleep(IN_FLIGHT_S)
        meanwhile()
        time.sleep(duration_s - IN_FLIGHT_S)
        count, wheels_mps = len(self.robot.commands), self.robot.speed_mps
        resumed_ns = rospy.Time.now().to_nsec()
        self.node.signal(signal.SIGCONT)
        time.sleep(0.5)
        commands = self.robot.commands[count:]
        decided = [speed_mps for stamp_ns, speed_mps in self.decided if stamp_ns >= resumed_ns]
        self.assertGreater(min(len(commands), len(decided)), 5)
        allowed_mps = wheels_mps + seen_late_mps(wheels_mps)
        if commands[0][1] > allowed_mps + STEP_UP_MPS:
            allowed_mps += BASE.linear_acceleration_mps2 * (commands[1][0] - commands[0][0] + SEEN_LATE_S)
            commands = commands[1:]
        return wheels_mps, allowed_mps, ([speed_mps for _, speed_mps in commands], decided)

    def assert_no_surge(self, allowed_mps, commands):
        """The first command is what the wheels do or less, and the others grow no faster than they may."""
        for speed_mps in commands:
            self.assertLessEqual(speed_mps, allowed_mps + STEP_UP_MPS)
            allowed_mps = speed_mps

    def test_stalled_process_goes_on_from_what_the_wheels_do(self):
        for duration_s in STALLS_S:
            with case(f"stalled for {duration_s} s"):  # A1
                wheels_mps, allowed_mps, commands = self.stall(duration_s)
                for speeds in commands:
                    self.assert_no_surge(allowed_mps, speeds)
                self.assertTrue(wheels_mps == 0.0 or duration_s < 1.0)
                self.cruise()

    def test_stalled_process_whose_lock_is_engaged_meanwhile_stays_at_rest(self):
        def lock():
            self.robot.dispatcher.message.engaged = True
            self.robot.planner.message.linear_mps = 0.0

        for duration_s in STALLS_S:
            with case(f"stalled for {duration_s} s"):  # A1
                _, allowed_mps, commands = self.stall(duration_s, lock)
                for speeds in commands:
                    self.assertLessEqual(max(speeds), allowed_mps)
                    self.assertEqual(speeds[-1], 0.0)
                self.robot.dispatcher.message.engaged = False
                self.cruise()

    def test_second_node_that_commands_the_wheels_stops_the_robot_and_is_named(self):  # A12
        other = rospy.Publisher(names.WHEEL_COMMAND, Twist, queue_size=1)
        wait_until(lambda: self.robot.commands[-1][1] == 0.0, "standstill", INTRUDER_SEEN_S + STANDS_AFTER_S)
        wait_until(lambda: rospy.get_name() in self.message, "a sentence that names the node", SAID_WITHIN_S)
        other.unregister()
        self.cruise()

    def test_it_is_named_also_where_a_launch_file_calls_the_wheels_topic_otherwise(self):  # A12
        self.node.stop()
        self.node = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control",
                                remaps={names.WHEEL_COMMAND: OTHER_COMMAND})
        other = rospy.Publisher(OTHER_COMMAND, Twist, queue_size=1)
        wait_until(lambda: rospy.get_name() in self.message and OTHER_COMMAND in self.message,
                   "a sentence that names the node", STARTED_WITHIN_S)
        other.unregister()

    def test_lidar_whose_frame_has_a_name_of_the_robots_own_is_taken_by_that_name_alone(self):
        self.node.stop()
        frame = f"{names.ROBOT_FRAMES}/{names.FRONT_LIDAR}"
        rospy.set_param(frame, "front_laser")
        self.node = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        try:
            wait_until(lambda: "frame 'front_lidar'" in self.message, "a refusal of the other frame")
            self.robot.front.message.header.frame_id = "front_laser"
            self.cruise()
        finally:
            self.robot.front.message.header.frame_id = names.FRONT_LIDAR
            rospy.delete_param(frame)

    def test_base_that_the_mast_does_not_survive_or_without_limits_ends_the_node_with_status_2(self):  # A2
        limit = f"/{CONTROLLER}/linear/x/max_acceleration"
        shipped = rospy.get_param(limit)
        self.node.stop()
        try:
            for value in (20.0, None):
                with case(f"max_acceleration {value}"):
                    rospy.delete_param(limit) if value is None else rospy.set_param(limit, value)
                    self.node = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
                    self.assertEqual(self.node.exit_status(), 2)
        finally:
            rospy.set_param(limit, shipped)

    def test_base_whose_limits_change_is_stopped_and_drives_again_when_they_are_restored(self):
        limit = f"/{CONTROLLER}/linear/x/max_acceleration"
        shipped = rospy.get_param(limit)
        try:
            for value in (20.0, shipped + 0.01, None):
                with case(f"max_acceleration {value}"):
                    rospy.delete_param(limit) if value is None else rospy.set_param(limit, value)
                    wait_until(lambda: self.robot.commands[-1][1] == 0.0, "standstill", CHANGE_SEEN_S + STANDS_AFTER_S)
                    wait_until(lambda: "max_acceleration" in self.message, "the limit's name", SAID_WITHIN_S)
                    rospy.set_param(limit, shipped)
                    wait_until(lambda: "max_acceleration" not in self.message, "its end", CHANGE_SEEN_S)
                    self.cruise()
        finally:
            rospy.set_param(limit, shipped)

    def test_process_that_is_ended_brakes_first_and_no_harder_than_it_may(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with case(f"signal {number}"):  # A2
                count, decided_count = len(self.robot.commands), len(self.decided)
                self.node.signal(number)
                self.assertEqual(self.node.exit_status(), 0)
                wait_until(lambda: self.robot.commands[-1][1] == self.decided[-1][1] == 0.0, "standstill")
                speeds = [speed for _, speed in self.robot.commands[count:]]
                # A tick that comes late brakes for all of the time since the one before, which its stamp tells.
                decided = self.decided[decided_count - 1:]
                self.assertLessEqual(set(speeds), {speed for _, speed in decided})
                for (before_ns, before_mps), (after_ns, after_mps) in zip(decided, decided[1:]):
                    passed_s = max((after_ns - before_ns) * NS, PERIOD_S)
                    self.assertLessEqual(before_mps - after_mps, HARDEST_MPS2 * passed_s)
                self.tearDown()
                self.setUp()


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "drive_control_process_test", DriveControlProcess, sys.argv)
