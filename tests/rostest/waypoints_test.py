#!/usr/bin/env python3
"""A waypoint's way from the Operator to the motion planner, and the answer's way back."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import PoseStamped
from scripted_time import NS, STEP_NS, Listener, ScriptedTime, Speaker, wait_for

from mtr_benchmarks.harness.operator_link import OperatorLink
from mtr_core import names, schedule
from mtr_core.conversions import goal_report_from
from mtr_core.requests import NO_GOAL_ID, RVIZ
from mtr_core.se2 import Pose2
from mtr_msgs.msg import (
    CarCheck,
    CarEstimate,
    DriveStatus,
    LocalizedPose,
    MotionStatus,
    PeripheralsState,
    RobotMode,
    VelocityCommand,
)
from mtr_proto import robot_link_pb2 as link

MAP_FROM_CAR = Pose2(1.0, 2.0, 0.5)
START_IN_CAR = Pose2(5.0, 1.0, math.pi)
HALF_LENGTH_M, HALF_WIDTH_M = 2.25, 0.9
TOLERANCE_M = 0.05
REACH_WITHIN_S = 60.0


class ScriptedRobot(Speaker):
    """Localization of a robot that obeys the planner exactly."""

    def __init__(self):
        super().__init__(names.LOCALIZED_POSE, LocalizedPose(valid=True), schedule.LOCALIZATION)
        self._velocity = Listener(names.PLANNER_VELOCITY, VelocityCommand, schedule.MOTION_PLANNER)
        self.place(MAP_FROM_CAR @ START_IN_CAR)

    def place(self, pose):
        """Put it somewhere."""
        message = self.message
        message.x, message.y, message.heading = pose.x, pose.y, pose.heading

    def speak(self, tick_ns):
        """One tick of motion, then its pose."""
        wanted = self._velocity.at(tick_ns - STEP_NS) or VelocityCommand()
        step_s = STEP_NS * NS
        turn = wanted.angular_radps * step_s
        now = Pose2(self.message.x, self.message.y, self.message.heading)
        self.place(now @ Pose2(wanted.linear_mps * step_s * math.cos(turn / 2.0),
                               wanted.linear_mps * step_s * math.sin(turn / 2.0), turn))
        self.message.speed_mps, self.message.yaw_rate_radps = wanted.linear_mps, wanted.angular_radps
        super().speak(tick_ns)


def nav_goal_topic():
    """Topic of the tool "2D Nav Goal" in the shipped configuration of rviz."""
    config = pathlib.Path(rospkg.RosPack().get_path("mtr_description")) / "rviz" / "robot.rviz"
    tools = yaml.safe_load(config.read_text(encoding="utf-8"))["Visualization Manager"]["Tools"]
    return next(tool["Topic"] for tool in tools if tool["Class"] == "rviz/SetGoal")


def located_car():
    """A Car that has been found."""
    car = CarEstimate(state=CarEstimate.LOCATED, x=MAP_FROM_CAR.x, y=MAP_FROM_CAR.y, heading=MAP_FROM_CAR.heading,
                      length=2.0 * HALF_LENGTH_M, width=2.0 * HALF_WIDTH_M)
    car.outline_x = [HALF_LENGTH_M, -HALF_LENGTH_M, -HALF_LENGTH_M, HALF_LENGTH_M]
    car.outline_y = [HALF_WIDTH_M, HALF_WIDTH_M, -HALF_WIDTH_M, -HALF_WIDTH_M]
    return car


class Waypoints(unittest.TestCase):
    """All tests are one session; waypoints count on."""

    waypoint_id = 0

    @classmethod
    def setUpClass(cls):
        rospy.init_node("waypoints_test", disable_rostime=True)
        speakers = [ScriptedRobot(), Speaker(names.CAR_ESTIMATE, located_car(), schedule.CAR_LOCATOR),
                    Speaker(names.CAR_CHECK, CarCheck(), schedule.CAR_LOCATOR),
                    Speaker(names.DRIVE_STATUS, DriveStatus(), schedule.DRIVE_CONTROL),
                    Speaker(names.PERIPHERALS_STATE, PeripheralsState(alive=True, battery=1.0), schedule.PERIPHERALS)]
        cls.motion = Listener(names.MOTION_STATUS, MotionStatus, schedule.MOTION_PLANNER)
        cls.mode = Listener(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        cls.time = ScriptedTime(["/dispatcher", "/state_machine", "/motion_planner"], speakers, [cls.motion, cls.mode])
        cls.nav_goal = rospy.Publisher(nav_goal_topic(), PoseStamped, queue_size=1)
        cls.operator = OperatorLink(rospy.get_param("~status_port"), rospy.get_param("~command_port"))
        cls.time.start()
        wait_for(cls.nav_goal.get_num_connections, "the planner's ear for goals from rviz")

    @classmethod
    def tearDownClass(cls):
        cls.operator.close()

    def go_to(self, x, y, heading=math.pi):
        """Order the next waypoint; returns its id."""
        Waypoints.waypoint_id += 1
        self.operator.order(waypoint=link.Waypoint(id=self.waypoint_id, x=x, y=y, heading=heading))
        return self.waypoint_id

    def nav_goal_at(self, x, y):
        """A person sets a goal in rviz, by its place in the Car's frame, while the Operator wants nothing."""
        self.operator.order()
        self.time.advance_until(lambda: not self.goal_now().requester.startswith("application"), within_s=5.0)
        before, pose = self.goal_now(), MAP_FROM_CAR @ Pose2(x, y, 0.0)
        goal = PoseStamped()
        goal.header.frame_id, goal.pose.position.x, goal.pose.position.y = names.MAP, pose.x, pose.y
        goal.pose.orientation.w = 1.0
        self.nav_goal.publish(goal)
        self.time.advance_until(lambda: self.goal_now() not in (NO_GOAL_ID, before), within_s=20.0)

    def seen(self, waypoint_id, result):
        """True when the Operator has heard this of the waypoint."""
        status = self.operator.status
        return status.waypoint_id == waypoint_id and status.waypoint_result == result

    def await_result(self, waypoint_id, result, within_s=REACH_WITHIN_S):
        """Let time pass until the Operator has heard it."""
        self.time.advance_until(lambda: self.seen(waypoint_id, result), within_s)

    def motion_now(self):
        """The planner's word on the present tick."""
        return self.motion.at(schedule.MOTION_PLANNER.last_at(self.time.tick_ns))

    def goal_now(self):
        """The goal that it speaks of."""
        return goal_report_from(self.motion_now()).goal_id

    def await_motion(self):
        """Let time pass until the robot drives."""
        self.time.advance_until(lambda: abs(self.operator.status.state.speed) > 0.2, within_s=10.0)

    def test_waypoint_is_reached_and_confirmed(self):
        reached = self.go_to(4.0, -1.0)
        self.await_result(reached, link.WAYPOINT_RESULT_REACHED)
        state = self.operator.status.state
        self.assertLess(math.hypot(state.x - 4.0, state.y + 1.0), TOLERANCE_M)

    def test_new_waypoint_replaces_the_old_one_in_mid_motion(self):
        old = self.go_to(-4.0, 2.5)
        self.await_motion()
        attempt = self.goal_now().attempt
        new = self.go_to(4.5, 2.5)
        results = []

        def is_reached():
            results.append((self.operator.status.waypoint_id, self.operator.status.waypoint_result))
            return self.seen(new, link.WAYPOINT_RESULT_REACHED)
        self.time.advance_until(is_reached, REACH_WITHIN_S)
        self.assertNotIn((old, link.WAYPOINT_RESULT_REACHED), results)
        self.assertGreater(self.goal_now().attempt, attempt)
        state = self.operator.status.state
        self.assertLess(math.hypot(state.x - 4.5, state.y - 2.5), TOLERANCE_M)

    def test_new_waypoint_is_taken_up_within_one_round_of_the_nodes(self):
        self.go_to(-4.0, 2.5)
        self.await_motion()
        attempt = self.goal_now().attempt
        self.go_to(4.0, 1.5)
        taken_s = self.time.advance_until(lambda: self.goal_now().attempt > attempt, within_s=1.0)
        self.assertLessEqual(taken_s, 0.25)

    def test_waypoint_inside_the_car_is_refused_with_a_sentence_and_nothing_moves(self):
        start = self.go_to(4.0, 2.0)
        self.await_result(start, link.WAYPOINT_RESULT_REACHED)
        before = self.operator.status.state
        refused = self.go_to(0.5, 0.0)
        self.await_result(refused, link.WAYPOINT_RESULT_REFUSED, within_s=1.0)
        self.time.advance_for(1.0)
        self.assertEqual(self.motion_now().result, MotionStatus.REFUSED)
        self.assertIn("Car", self.motion_now().message)
        self.assertEqual(self.operator.status.waypoint_message, self.motion_now().message)
        after = self.operator.status.state
        self.assertEqual((after.x, after.y, after.speed), (before.x, before.y, 0.0))

    def test_goal_from_rviz_is_driven_to_while_the_operator_wants_nothing(self):
        self.await_result(self.go_to(4.0, -1.0), link.WAYPOINT_RESULT_REACHED)
        self.nav_goal_at(4.5, 1.5)
        self.time.advance_until(lambda: self.motion_now().result == MotionStatus.REACHED, REACH_WITHIN_S)
        state = self.operator.status.state
        self.assertLess(math.hypot(state.x - 4.5, state.y - 1.5), TOLERANCE_M)

    def test_goal_from_rviz_inside_the_keep_out_zone_is_refused_with_a_sentence_and_nothing_moves(self):
        self.await_result(self.go_to(4.0, -1.0), link.WAYPOINT_RESULT_REACHED)
        before = self.operator.status.state
        self.nav_goal_at(HALF_LENGTH_M + 0.2, 0.0)
        self.assertEqual(self.motion_now().result, MotionStatus.REFUSED)
        self.assertIn("to the Car", self.motion_now().message)
        self.time.advance_for(1.0)
        after = self.operator.status.state
        self.assertEqual((after.x, after.y, after.speed), (before.x, before.y, 0.0))

    def test_waypoint_of_the_operator_goes_before_a_goal_from_rviz(self):
        self.await_result(self.go_to(4.0, -1.0), link.WAYPOINT_RESULT_REACHED)
        self.nav_goal_at(-4.0, 2.5)
        self.await_motion()
        self.await_result(self.go_to(4.5, 2.0), link.WAYPOINT_RESULT_REACHED)
        self.assertNotEqual(self.goal_now().requester, RVIZ)

    def test_refused_waypoint_in_mid_motion_stops_the_robot(self):
        self.go_to(-4.0, -2.5)
        self.await_motion()
        refused = self.go_to(0.0, 0.0)
        self.await_result(refused, link.WAYPOINT_RESULT_REFUSED, within_s=5.0)
        self.time.advance_until(lambda: self.operator.status.state.speed == 0.0, within_s=3.0)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "waypoints_test", Waypoints, sys.argv)
