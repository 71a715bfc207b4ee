"""ROS messages to the observation, and the decision to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, Optional

import rospy

from mtr_core.problems import NO_PROBLEM, Problem, messages_of, problem_of
from mtr_core.states import CarState, Check, Result
from mtr_msgs.msg import CarCheck, CarEstimate, DesiredState, MotionLock, MotionStatus, RobotMode, Waypoint
from mtr_msgs.msg import Problem as ProblemMessage

from . import problems
from .core import Decision
from .observation import Car, CheckReport, Desired, Motion, Observation, Part, Place

OWNER = "state_machine"
NS = 1e-9


def observation(messages: Dict[Part, Optional[Any]], check: Optional[CarCheck], tick_ns: int) -> Observation:
    """What the newest message of each part, and the self-check's, tell at the tick."""
    arrived = {part: message for part, message in messages.items() if message is not None}
    age_s = {part: (tick_ns - message.header.stamp.to_nsec()) * NS for part, message in arrived.items()}
    complaint = {part: complaint_of(arrived[part]) for part, complaint_of in COMPLAINTS.items() if part in arrived}
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
    return Car(CarState(message.state), place(message.next_waypoint), message.map_car_id, _problem(message))


def check_report(message: CarCheck) -> CheckReport:
    """The self-check's state."""
    return CheckReport(message.id, Check(message.state), _problem(message))


def motion(message: MotionStatus) -> Motion:
    """The planner's report."""
    return Motion(message.goal_id, Result(message.result), _problem(message))


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
        waypoint_result=decision.waypoint_result.value, message=decision.message.text,
        problems=messages_of(decision.message, ProblemMessage),
        check_car_id=decision.check_car_id)
    message.header.stamp = stamp
    return message


def lock_message(decision: Decision, stamp: rospy.Time) -> MotionLock:
    """Reason to stand still, for drive control."""
    message = MotionLock(owner=OWNER, engaged=bool(decision.lock_reason), reason=decision.lock_reason.text,
                         problems=messages_of(decision.lock_reason, ProblemMessage))
    message.header.stamp = stamp
    return message


def _problem(message: Any) -> Problem:
    return problem_of(message.problems, message.message)


def _localization_complaint(message: Any) -> Problem:
    if message.valid:
        return NO_PROBLEM
    cause = _problem(message)
    return problems.LOCALIZATION_LOST_BECAUSE(cause=cause) if cause else problems.LOCALIZATION_LOST()


def _peripherals_complaint(message: Any) -> Problem:
    return NO_PROBLEM if message.alive else _problem(message) or problems.FIRMWARE_SILENT()


COMPLAINTS = {Part.LOCALIZATION: _localization_complaint, Part.PERIPHERALS: _peripherals_complaint}
