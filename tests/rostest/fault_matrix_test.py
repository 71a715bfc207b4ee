#!/usr/bin/env python3
"""In every state of the robot every fault of what moves or watches it leads to standstill within half a second."""
# SPDX-License-Identifier: Apache-2.0
import sys
import unittest

import rospy
import rostest
from case import case
from geometry_msgs.msg import Twist
from scripted_sensors import open_ground
from scripted_time import NS, STEP_NS, Listener, LockListener, ScriptedTime, Speaker
from sensor_msgs.msg import Joy

from mtr_core import names, schedule
from mtr_msgs.msg import (
    CarCheck,
    CarEstimate,
    DesiredState,
    DriveStatus,
    LocalizedPose,
    MotionLock,
    MotionStatus,
    RobotMode,
    VelocityCommand,
)

STANDSTILL_WITHIN_S = 0.5
# The planner wants more than is permitted; with the key raised, the hardest case, drive control allows this.
WANTED_MPS, FASTEST_MPS = 2.0, 0.74
KEY_RAISED_M = 1.55
AXES, BUTTONS = 8, 12
SLOW_BUTTON, FORWARD_AXIS, RELEASE_BUTTONS = 4, 1, (8, 9)
# The buttons of the emergency stop have to be held for a second; what was said first may not have been heard.
RELEASED_WITHIN_S = 1.4
# From the planner's speed to that of a slow hand.
TAKEN_OVER_WITHIN_S, DRIVEN_FOR_S = 1.0, 1.0
# By the wall clock; in simulated time more than the 0.1 s after which the controller counts as lost.
LONG_UNDER_WAY_WALL_S = 0.25
LOCKED = (RobotMode.STARTING, RobotMode.FAULT)
RECOVERED_WITHIN_S = 4.0


class FaultMatrix(unittest.TestCase):
    """One robot goes through all states; in each of them a planner wants to drive at any price."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("fault_matrix_test", disable_rostime=True)
        cls.lidar, cls.rear_lidar, cls.odometry, imu, peripherals = open_ground()
        peripherals.message.key_height_m = KEY_RAISED_M
        cls.planner = Speaker(names.PLANNER_VELOCITY, VelocityCommand(linear_mps=WANTED_MPS, active=True),
                              schedule.MOTION_PLANNER)
        cls.motion = Speaker(names.MOTION_STATUS, MotionStatus(), schedule.MOTION_PLANNER)
        cls.e_stop = Speaker(names.MOTION_LOCK, MotionLock(owner="dispatcher"), schedule.DISPATCHER)
        cls.joystick = Speaker(names.JOY, Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS), schedule.CONTROLLER_INPUT)
        cls.desired = Speaker(names.DESIRED_STATE, DesiredState(session_id=1, link_alive=True, max_speed_mps=1.0),
                              schedule.DISPATCHER)
        cls.pose = Speaker(names.LOCALIZED_POSE, LocalizedPose(valid=False, message="Lost."), schedule.LOCALIZATION)
        cls.car = Speaker(names.CAR_ESTIMATE, CarEstimate(), schedule.CAR_LOCATOR)
        cls.check = Speaker(names.CAR_CHECK, CarCheck(), schedule.CAR_LOCATOR)
        cls.faults = {"LiDAR silent": [cls.lidar], "odometry silent": [cls.odometry],
                      "planner killed": [cls.planner, cls.motion], "joystick unplugged": [cls.joystick],
                      "e-stop source silent": [cls.e_stop]}
        cls.hand_lock = LockListener("controller_input", schedule.CONTROLLER_INPUT)
        cls.drive = Listener(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL)
        cls.mode = Listener(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        speakers = [cls.lidar, cls.rear_lidar, cls.odometry, imu, peripherals, cls.planner, cls.motion, cls.e_stop,
                    cls.joystick, cls.desired, cls.pose, cls.car, cls.check]
        cls.time = ScriptedTime(["/drive_control", "/state_machine", "/controller_input"], speakers,
                                [cls.drive, cls.mode, cls.hand_lock])
        # Drive control's holds tell how many of these the simulator must have got.
        cls.wheels = rospy.Subscriber(names.WHEEL_COMMAND, Twist, cls.roll, tcp_nodelay=True)
        cls.time.start()
        for button in RELEASE_BUTTONS:
            cls.joystick.message.buttons[button] = 1
        cls.time.advance_until(cls.is_released, RELEASED_WITHIN_S)
        cls.joystick.message.buttons = [0] * BUTTONS

    @classmethod
    def is_released(cls):
        """The manual controller locks the robot no longer."""
        lock = cls.hand_lock.at(cls.time.tick_ns)
        return lock is not None and not lock.engaged

    @classmethod
    def roll(cls, message):
        """The wheels obey."""
        cls.odometry.obey(message)
        cls.time.holds.count(message)

    def speed(self):
        """Linear and angular velocity sent to the wheels."""
        status = self.drive.at(self.time.tick_ns)
        return abs(status.linear_mps) + abs(status.angular_radps)

    def mode_now(self):
        """The robot's state."""
        mode = self.mode.at(self.time.tick_ns - STEP_NS)
        return mode.mode if mode else RobotMode.STARTING

    def go_on(self, mode):
        """Let time pass until the robot is in the state and drives, or stands where it must."""
        locked = mode in LOCKED
        self.time.advance_until(
            lambda: self.mode_now() == mode and (self.speed() == 0.0 if locked else self.speed() >= FASTEST_MPS),
            RECOVERED_WITHIN_S)

    def inject(self, speakers):
        """Silence the speakers; the robot stands soon enough after their last word, and goes on standing."""
        for speaker in speakers:
            speaker.is_silent = True
        silent_since_ns = max(speaker.heard_ns for speaker in speakers)
        while (self.time.tick_ns - silent_since_ns) * NS < STANDSTILL_WITHIN_S:
            self.time.advance()
        speeds = []
        for _ in range(10):
            speeds.append(self.speed())
            self.time.advance()
        for speaker in speakers:
            speaker.is_silent = False
        self.assertEqual(max(speeds), 0.0)

    def check_all_faults(self, mode):
        """One row of the matrix."""
        for name, speakers in self.faults.items():
            with case(f"fault {name}"):
                self.go_on(mode)
                self.inject(speakers)
        self.go_on(mode)

    def test_1_starting(self):
        self.check_all_faults(RobotMode.STARTING)

    def test_2_ready_to_map_car(self):
        self.pose.message.valid = True
        self.check_all_faults(RobotMode.READY_TO_MAP_CAR)

    def test_3_mapping_car(self):
        self.desired.message.map_car_id = 1
        self.car.message.state, self.car.message.map_car_id = CarEstimate.COLLECTING, 1
        self.check_all_faults(RobotMode.MAPPING_CAR)

    def test_4_following_waypoint(self):
        self.car.message.state = CarEstimate.LOCATED
        self.check_all_faults(RobotMode.FOLLOWING_WAYPOINT)

    def test_5_manual_controller_unplugged_while_it_drives(self):
        self.drive_by_hand()
        self.inject([self.joystick])
        # Back, but with the button held: the robot does not set off by surprise.
        self.time.advance_for(1.0)
        self.assertEqual(self.speed(), 0.0)
        self.push(False)
        self.go_on(RobotMode.FOLLOWING_WAYPOINT)

    def push(self, is_pushed):
        """The person at the manual controller drives slowly ahead, or lets go."""
        self.joystick.message.buttons[SLOW_BUTTON] = int(is_pushed)
        self.joystick.message.axes[FORWARD_AXIS] = float(is_pushed)

    def drive_by_hand(self):
        """Push once: the person takes the robot over and keeps it."""
        self.push(True)
        self.time.advance_until(self.is_driven_by_hand, TAKEN_OVER_WITHIN_S)
        for _ in range(round(DRIVEN_FOR_S / (STEP_NS * NS))):
            self.time.advance()
            self.assertTrue(self.is_driven_by_hand(), self.drive.at(self.time.tick_ns).message)

    def is_driven_by_hand(self):
        """The manual controller has the wheels, and drives."""
        return self.drive.at(self.time.tick_ns).source == "manual" and self.speed() > 0.3

    def test_5_manual_controller_is_not_lost_because_its_words_are_long_under_way(self):
        self.joystick.under_way_wall_s = LONG_UNDER_WAY_WALL_S
        self.drive_by_hand()
        self.push(False)
        self.go_on(RobotMode.FOLLOWING_WAYPOINT)
        self.joystick.arrive()

    def test_6_checking_car(self):
        self.desired.message.check_car_id = 1
        self.check.message.id, self.check.message.state = 1, CarCheck.RUNNING
        self.check_all_faults(RobotMode.CHECKING_CAR)

    def test_7_fault(self):
        self.pose.message.valid = False
        self.check_all_faults(RobotMode.FAULT)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "fault_matrix_test", FaultMatrix, sys.argv)
