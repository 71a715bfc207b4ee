"""Plain data of the dispatcher to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
from genpy import Time

from mtr_core.conversions import desired_state_message
from mtr_core.problems import messages_of
from mtr_msgs.msg import DesiredState, MotionLock, Problem

from .session import SessionState, desired_state

OWNER = "dispatcher"


def desired_message(desired: SessionState, stamp: Time, default_speed_mps: float) -> DesiredState:
    """What the Operator wants, for the other nodes."""
    message = desired_state_message(desired_state(desired, default_speed_mps))
    message.header.stamp = stamp
    return message


def lock_message(desired: SessionState, stamp: Time) -> MotionLock:
    """Reason to stand still, for drive control."""
    message = MotionLock(owner=OWNER, engaged=bool(desired.stop_reason), reason=desired.stop_reason.text,
                         problems=messages_of(desired.stop_reason, Problem))
    message.header.stamp = stamp
    return message
