"""Converts requests and their reports to ROS messages and back, for all nodes."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from genpy import Time

from mtr_msgs import msg

from .problems import messages_of, problem_of
from .requests import DesiredState, Goal, GoalId, GoalReport, Press, Waypoint
from .se2 import Pose2
from .states import Result


def stamp_of(time_ns: int) -> Time:
    """Return nanoseconds as the stamp of a message."""
    return Time(time_ns // 1_000_000_000, time_ns % 1_000_000_000)


def waypoint_from(message: msg.Waypoint) -> Waypoint:
    """Return a waypoint as plain data."""
    return Waypoint(message.id, message.requester, message.frame_id, Pose2(message.x, message.y, message.heading),
                    message.direction)


def waypoint_message(waypoint: Waypoint) -> msg.Waypoint:
    """Return a waypoint as a message."""
    pose = waypoint.pose
    return msg.Waypoint(id=waypoint.id, requester=waypoint.requester, frame_id=waypoint.frame, x=pose.x, y=pose.y,
                        heading=pose.heading, direction=waypoint.direction)


def goal_from(message: msg.RobotMode) -> Goal:
    """Return the goal that the state machine has set."""
    return Goal(waypoint_from(message.goal), message.goal_attempt)


def goal_report_from(message: Optional[msg.MotionStatus]) -> GoalReport:
    """Return the motion planner's report; without a message it refers to no goal."""
    if message is None:
        return GoalReport()
    goal_id = GoalId(message.requester, message.goal_id, message.goal_attempt)
    return GoalReport(goal_id, Result(message.result), problem_of(message.problems, message.message))


def desired_state_from(message: msg.DesiredState) -> DesiredState:
    """Return the desired state as plain data."""
    press = message.press
    return DesiredState(
        session_id=message.session_id, command_id=message.command_id, link_alive=message.link_alive,
        stop=message.stop, waypoint=waypoint_from(message.waypoint), max_speed_mps=message.max_speed_mps,
        key_height_m=message.key_height_m,
        press=Press(press.id, message.session_id, tuple(press.buttons), press.strength, press.duration_s),
        map_car_id=message.map_car_id, check_car_id=message.check_car_id, resume_hold_id=message.resume_hold_id,
        area_problem=problem_of(message.area_problems, ""))


def desired_state_message(desired: DesiredState) -> msg.DesiredState:
    """Return the desired state as a message without a stamp."""
    press = desired.press
    return msg.DesiredState(
        session_id=desired.session_id, command_id=desired.command_id, link_alive=desired.link_alive,
        stop=desired.stop, waypoint=waypoint_message(desired.waypoint), max_speed_mps=desired.max_speed_mps,
        key_height_m=desired.key_height_m,
        press=msg.ButtonPress(press.id, list(press.buttons), press.strength, press.duration_s),
        map_car_id=desired.map_car_id, check_car_id=desired.check_car_id, resume_hold_id=desired.resume_hold_id,
        area_problems=messages_of(desired.area_problem, msg.Problem))
