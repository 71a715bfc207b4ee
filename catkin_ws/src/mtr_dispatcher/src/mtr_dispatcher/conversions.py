"""Converts plain data of the dispatcher to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional

from genpy import Time

from mtr_core import names
from mtr_core.conversions import desired_state_message
from mtr_core.problems import NO_PROBLEM, Problem, messages_of
from mtr_msgs.msg import DesiredState, MotionLock, TestArea
from mtr_msgs.msg import Problem as ProblemMessage

from .area.keeper import AreaKeeper
from .session import SessionState, desired_state

OWNER = "dispatcher"


def desired_message(desired: SessionState, stamp: Time, default_speed_mps: float,
                    area_problem: Problem = NO_PROBLEM) -> DesiredState:
    """Return the desired state for the other nodes."""
    message = desired_state_message(desired_state(desired, default_speed_mps, area_problem))
    message.header.stamp = stamp
    return message


def lock_message(desired: SessionState, stamp: Time) -> MotionLock:
    """Return the dispatcher's motion lock for drive control."""
    message = MotionLock(owner=OWNER, engaged=bool(desired.stop_reason), reason=desired.stop_reason.text,
                         problems=messages_of(desired.stop_reason, ProblemMessage))
    message.header.stamp = stamp
    return message


def service_lock_message(desired: SessionState, stamp: Time) -> MotionLock:
    """Service mode as an emergency stop: it also stops lift, servos and presses, and outlives the dispatcher."""
    message = MotionLock(owner=names.SERVICE_MODE, engaged=bool(desired.service), reason=desired.service.text,
                         problems=messages_of(desired.service, ProblemMessage), emergency=True)
    message.header.stamp = stamp
    return message


def service_lock_messages(before: Optional[SessionState], desired: SessionState, stamp: Time) -> List[MotionLock]:
    """Lock of service mode. A release follows an engagement at once: receivers latch a stop that
    was silent before its release, and storing the end of service mode takes time.
    """
    ends = before is not None and bool(before.service) and not desired.service
    states = (before, desired) if before is not None and ends else (desired,)
    return [service_lock_message(each, stamp) for each in states]


def area_message(areas: AreaKeeper, stamp: Time) -> TestArea:
    """Return the area in force for drive control and the planner."""
    message = TestArea(required=areas.required, origin_id=areas.area.origin_id if areas.area is not None else 0,
                       x=[x for x, _ in areas.corners], y=[y for _, y in areas.corners])
    message.header.stamp, message.header.frame_id = stamp, names.MAP
    return message
