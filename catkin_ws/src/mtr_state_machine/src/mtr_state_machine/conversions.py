"""ROS messages to the observation, and the decision to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, Optional

import rospy

from mtr_core.states import CarState, Check, Result
from mtr_msgs.msg import CarCheck, CarEstimate, DesiredState, MotionLock, MotionStatus, RobotMode, Waypoint

from .core import Decision
from .observation import Car, CheckReport, Desired, Motion, Observation, Part, Place

OWNER = "state_machine"
NS = 1e-9


def observation(messages: Dict[Part, Optional[Any]], check: Optional[CarCheck], tick_ns: int) -> Observation:
    """What the newest message of each part, and the self-check's, tell at the tick."""
    arrived = {part: message for part, message in messages.items() if message is not None}
    age_s = {part: (tick_ns - message.header.stamp.to_nsec()) * NS for part, message in arrived.items()}
    complaint = {part: sentence(arrived[part]) for part, sentence in COMPLAINTS.items() if part in arrived}
    return Observation(
        desired=desired(arrived.get(Part.DISPATCHER, DesiredState(stop=True))),
        car=car(arrived.get(Part.CAR_LOCATOR, CarEstimate())),
        check=check_report(check or CarCheck()),
        map_revision=arrived[Part.LOCALIZATION].map_revision if Part.LOCALIZATION in arrived else 0,
        motion=motion(arrived.get(Part.MOTION_PLANNER, MotionStatus())),
        age_s=age_s, complaint=complaint)


def desired(message: DesiredState) -> Desired:
    """What the Operator wants."""
    return Desired(message.session_id, message.link_alive, message.stop, place(message.waypoint),
                   message.max_speed_mps, message.map_car_id, message.check_car_id)


def car(message: CarEstimate) -> Car:
    """The Car locator's state."""
    return Car(CarState(message.state), place(message.next_waypoint), message.map_car_id, message.message)


def check_report(message: CarCheck) -> CheckReport:
    """The self-check's state."""
    return CheckReport(message.id, Check(message.state), message.message)


def motion(message: MotionStatus) -> Motion:
    """The planner's report."""
    return Motion(message.goal_id, Result(message.result), message.message)


def place(message: Waypoint) -> Place:
    """A waypoint as plain data."""
    return Place(message.id, message.frame_id, message.x, message.y, message.heading, message.direction)


def mode_message(decision: Decision, stamp: rospy.Time) -> RobotMode:
    """Mode and goal, for the other nodes."""
    goal = decision.goal
    message = RobotMode(
        mode=decision.state.value, max_speed_mps=decision.max_speed_mps, mapping=decision.mapping,
        goal=Waypoint(goal.id, goal.frame_id, goal.x, goal.y, goal.heading, goal.direction),
        map_car_id=decision.map_car_id, session_id=decision.session_id, waypoint_id=decision.waypoint_id,
        waypoint_result=decision.waypoint_result.value, message=decision.message,
        check_car_id=decision.check_car_id)
    message.header.stamp = stamp
    return message


def lock_message(decision: Decision, stamp: rospy.Time) -> MotionLock:
    """Reason to stand still, for drive control."""
    message = MotionLock(owner=OWNER, engaged=bool(decision.lock_reason), reason=decision.lock_reason)
    message.header.stamp = stamp
    return message


def _localization_complaint(message: Any) -> str:
    return "" if message.valid else f"Localization is lost. {message.message}".rstrip()


def _peripherals_complaint(message: Any) -> str:
    return "" if message.alive else message.message or "The firmware of lift and buttons is silent."


COMPLAINTS = {Part.LOCALIZATION: _localization_complaint, Part.PERIPHERALS: _peripherals_complaint}
