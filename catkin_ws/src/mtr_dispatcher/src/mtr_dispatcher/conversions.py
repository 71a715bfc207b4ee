"""Plain data of the dispatcher to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
import math

import rospy

from mtr_core import names
from mtr_core.problems import messages_of
from mtr_msgs.msg import ButtonPress, DesiredState, MotionLock, Problem, Waypoint

from .command import Command
from .session import Desired

OWNER = "dispatcher"


def desired_message(desired: Desired, stamp: rospy.Time, default_speed_mps: float) -> DesiredState:
    """What the Operator wants, for the other nodes."""
    command = desired.command
    message = DesiredState(
        session_id=desired.session_id, command_id=command.id, link_alive=desired.link_alive,
        stop=bool(desired.stop_reason), waypoint=_waypoint(command), map_car_id=desired.map_order,
        check_car_id=desired.check_order,
        max_speed_mps=default_speed_mps if command.max_speed_mps is None else command.max_speed_mps,
        key_height_m=math.nan if command.key_height_m is None else command.key_height_m, press=_press(command))
    message.header.stamp = stamp
    return message


def lock_message(desired: Desired, stamp: rospy.Time) -> MotionLock:
    """Reason to stand still, for drive control."""
    message = MotionLock(owner=OWNER, engaged=bool(desired.stop_reason), reason=desired.stop_reason.text,
                         problems=messages_of(desired.stop_reason, Problem))
    message.header.stamp = stamp
    return message


def _waypoint(command: Command) -> Waypoint:
    wanted = command.waypoint
    if wanted is None:
        return Waypoint(frame_id=names.CAR)
    return Waypoint(wanted.id, names.CAR, wanted.x, wanted.y, wanted.heading, wanted.direction)


def _press(command: Command) -> ButtonPress:
    wanted = command.press
    if wanted is None:
        return ButtonPress()
    return ButtonPress(wanted.id, list(wanted.buttons), wanted.strength, wanted.duration_s)
