"""Converts ROS messages to the observation, and the decision to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, Optional

from genpy import Time

from mtr_core.conversions import desired_state_from, goal_report_from, waypoint_from, waypoint_message
from mtr_core.problems import NO_PROBLEM, Problem, messages_of, problem_of
from mtr_core.requests import DesiredState
from mtr_core.states import CarState, Check
from mtr_msgs.msg import CarCheck, CarEstimate, DriveStatus, LocalizedPose, MotionLock, PeripheralsState, RobotMode
from mtr_msgs.msg import Problem as ProblemMessage

from . import problems
from .core import Decision
from .observation import NO_EMERGENCY, Car, CheckReport, Drive, Emergency, Observation, Part

OWNER = "state_machine"
# Value of DriveStatus.source.
MANUAL = "manual"
# Value of PeripheralsState.signal.
SETS_OFF = 1


def observation(messages: Dict[Part, Optional[Any]], check: Optional[CarCheck], ages_s: Dict[Part, float],
                now_s: float, emergency: Emergency = NO_EMERGENCY) -> Observation:
    """Return the observation at a time of the steady clock.

    It consists of the newest message of each part with its age, the self-check and the emergency stops.
    """
    arrived = {part: message for part, message in messages.items() if message is not None}
    age_s = {part: ages_s[part] for part in arrived}
    complaint = {part: complaint_of(arrived[part]) for part, complaint_of in COMPLAINTS.items() if part in arrived}
    peripherals = arrived.get(Part.PERIPHERALS) or PeripheralsState(battery=math.nan)
    return Observation(
        desired=desired_state_from(arrived[Part.DISPATCHER]) if Part.DISPATCHER in arrived else DesiredState(),
        car=car(arrived.get(Part.CAR_LOCATOR, CarEstimate())),
        check=check_report(check or CarCheck()),
        map_revision=arrived[Part.LOCALIZATION].map_revision if Part.LOCALIZATION in arrived else 0,
        motion=goal_report_from(arrived.get(Part.MOTION_PLANNER)),
        age_s=age_s, complaint=complaint,
        is_position_lost=_is_position_lost(arrived.get(Part.LOCALIZATION, LocalizedPose())),
        drive=drive(arrived.get(Part.DRIVE_CONTROL, DriveStatus())), emergency=emergency,
        firmware_resets=peripherals.firmware_resets, lift_jams=peripherals.lift_jams,
        signals_motion=peripherals.signal == SETS_OFF, now_s=now_s, battery=peripherals.battery)


def car(message: CarEstimate) -> Car:
    """Return the Car locator's state."""
    return Car(CarState(message.state), waypoint_from(message.next_waypoint), message.map_car_id, _problem(message))


def check_report(message: CarCheck) -> CheckReport:
    """Return the self-check's state."""
    return CheckReport(message.id, Check(message.state), _problem(message))


def drive(message: DriveStatus) -> Drive:
    """Return the source of motion, and drive control's counts of manual drives and blockages."""
    is_moving = message.linear_mps != 0.0 or message.angular_radps != 0.0
    return Drive(message.source == MANUAL, is_moving, message.manual_drives, message.blockages)


def mode_message(decision: Decision, stamp: Time) -> RobotMode:
    """Return mode and goal for the other nodes."""
    goal = decision.goal
    message = RobotMode(
        mode=decision.state.value, max_speed_mps=decision.max_speed_mps, mapping=decision.mapping,
        goal=waypoint_message(goal.waypoint), goal_attempt=goal.attempt,
        map_car_id=decision.map_car_id, session_id=decision.session_id, waypoint_id=decision.waypoint_id,
        waypoint_result=decision.waypoint_result.value, message=decision.message.text,
        problems=messages_of(decision.message, ProblemMessage),
        check_car_id=decision.check_car_id, hold_id=decision.hold_id, sets_off=decision.sets_off)
    message.header.stamp = stamp
    return message


def lock_message(decision: Decision, stamp: Time) -> MotionLock:
    """Return the state machine's motion lock for drive control."""
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


def _is_position_lost(message: LocalizedPose) -> bool:
    return not message.valid and message.mode == LocalizedPose.LOST


def _peripherals_complaint(message: Any) -> Problem:
    return NO_PROBLEM if message.alive else _problem(message) or problems.FIRMWARE_SILENT()


COMPLAINTS = {Part.LOCALIZATION: _localization_complaint, Part.PERIPHERALS: _peripherals_complaint}
