"""Converts messages of the link to and from the types of the domain's ports."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Iterable

from google.protobuf.message import DecodeError

from mtr_operator.domain import requests, robot_status
from mtr_operator.domain.geometry.pose import Pose
from mtr_proto import robot_link_pb2 as pb
from mtr_proto.parsing import parse_whole

from .area import area_message, area_order_from, area_state_from, fill_area_state
from .plausibility import not_finite, plausible, violation_of
from .preflight import preflight_from, preflight_message
from .surroundings import surroundings_from, surroundings_message

MAX_MESSAGE_BYTES = 64 * 1024
_COUNTS = tuple(field.name for field in dataclasses.fields(robot_status.Interventions))
_SIDE_SIGMAS = ("front_sigma", "rear_sigma", "left_sigma", "right_sigma")
_CHECK_FIGURES = ("difference_m", "difference_rad", "limit_m", "limit_rad")


class UndecodableMessage(ValueError):
    """Bytes that are not a message of the link."""


class ImplausibleMessage(UndecodableMessage):
    """Message with an implausible number."""


@dataclass(frozen=True)
class CommandHeader:
    """Fields of a Command in addition to the desired state; the proto describes them."""

    session_id: int
    id: int
    sent_time_s: float
    seen_status_id: int | None = None
    seen_robot_time_s: float | None = None
    end_session: bool = False
    watches: bool = False


def command_from_desired(desired: requests.DesiredState, header: CommandHeader) -> pb.Command:
    """Return a Command with this header; None is an absent field."""
    command = pb.Command(session_id=header.session_id, id=header.id, sent_time_s=header.sent_time_s,
                         stop=desired.stop, map_car_id=desired.map_car_id, check_car_id=desired.check_car_id,
                         resume_hold_id=desired.resume_hold_id, enter_service=desired.enters_service,
                         leave_service_id=desired.leave_service_id)
    for name, value in (("seen_status_id", header.seen_status_id), ("seen_robot_time_s", header.seen_robot_time_s),
                        ("max_speed_mps", desired.max_speed_mps), ("device_height_m", desired.key_height_m)):
        if value is not None:
            setattr(command, name, value)
    if header.end_session:
        command.end_session = True
    if header.watches:
        command.watches = True
    if desired.waypoint is not None:
        waypoint, pose = desired.waypoint, desired.waypoint.pose
        command.waypoint.CopyFrom(pb.Waypoint(id=waypoint.id, x=pose.x, y=pose.y, heading=pose.heading,
                                              direction=waypoint.direction.value))
    if desired.area is not None:
        command.test_area.CopyFrom(area_message(desired.area))
    if desired.press is not None:
        press = desired.press
        command.press.CopyFrom(pb.ButtonPress(id=press.id, buttons=press.buttons, strength=press.strength,
                                              duration_s=press.duration_s))
    return command


def desired_from_command(command: pb.Command) -> requests.DesiredState:
    """Return the content of a Command; absent fields are None."""
    waypoint = press = None
    if command.HasField("waypoint"):
        sent = command.waypoint
        waypoint = requests.Waypoint(sent.id, Pose(sent.x, sent.y, sent.heading),
                                     requests.Direction(sent.direction))
    if command.HasField("press"):
        pressed = command.press
        press = requests.Press(pressed.id, tuple(pressed.buttons), pressed.strength, pressed.duration_s)
    return requests.DesiredState(stop=command.stop, waypoint=waypoint, press=press, map_car_id=command.map_car_id,
                              check_car_id=command.check_car_id, resume_hold_id=command.resume_hold_id,
                              max_speed_mps=_value(command, "max_speed_mps", None),
                              key_height_m=_value(command, "device_height_m", None),
                              area=area_order_from(command.test_area) if command.HasField("test_area") else None,
                              enters_service=command.enter_service, leave_service_id=command.leave_service_id)


def decode_command(payload: bytes) -> pb.Command:
    """Return the Command in one ZeroMQ frame, or raise UndecodableMessage."""
    return _decode(payload, pb.Command(), ("session_id", "id"))


def decode_status(payload: bytes) -> robot_status.RobotStatus:
    """Return the Status in one ZeroMQ frame; UndecodableMessage for other bytes and for implausible numbers."""
    message = _decode(payload, pb.Status(), ("id", "robot_session_id", "sent_time_s"))
    status = plausible(robot_status_from(message))
    violation = violation_of(status) or not_finite(message)
    if violation:
        raise ImplausibleMessage(f"Status {message.id} was ignored: {violation}")
    return status


def _decode(payload: bytes, message: Any, required: tuple[str, ...]) -> Any:
    try:
        parse_whole(message, payload)
    except DecodeError:
        raise UndecodableMessage(f"{len(payload)} bytes are no {message.DESCRIPTOR.name}.") from None
    for name in required:
        if not message.HasField(name):
            raise UndecodableMessage(f"A {message.DESCRIPTOR.name} lacks {name}.")
    return message


def robot_status_from(message: pb.Status) -> robot_status.RobotStatus:
    """Return the Status as a type of the domain.

    stamp_s is the time of the pose while the pose is valid, else the time of sending: robot time continues while the
    robot is lost.
    """
    state = message.state
    pose_time_s = _value(state, "stamp_s", math.nan)
    on_time = state.pose_valid and math.isfinite(pose_time_s)
    return robot_status.RobotStatus(
        id=message.id, robot_session_id=message.robot_session_id,
        stamp_s=pose_time_s if on_time else message.sent_time_s,
        x=_value(state, "x", math.nan), y=_value(state, "y", math.nan), heading=_value(state, "heading", math.nan),
        speed_mps=state.speed, yaw_rate_radps=state.yaw_rate_radps, pose_valid=state.pose_valid,
        position_sigma_m=_value(state, "position_sigma_m", math.nan),
        variance_x_m2=_value(state, "variance_x_m2", math.nan), variance_y_m2=_value(state, "variance_y_m2", math.nan),
        covariance_xy_m2=_value(state, "covariance_xy_m2", math.nan),
        heading_sigma_rad=_value(state, "heading_sigma_rad", math.nan),
        key_x=state.key_x, key_y=state.key_y, key_height_m=_value(state, "device_height", math.nan),
        pressed_buttons=tuple(state.pressed_device_buttons),
        localization_accuracy_cm=_value(state, "localization_accuracy", None),
        battery_percent=_value(state, "battery_level", None), is_mapping_car=state.is_mapping_car,
        mode=robot_status.Mode(message.mode), car=_car_from(message.car), car_frame=_frame_from(message.car),
        car_check=_check_from(message.car_check) if message.HasField("car_check") else None,
        session_id=message.session_id, command_id=message.command_id, waypoint_id=message.waypoint_id,
        waypoint_result=robot_status.WaypointResult(message.waypoint_result), waypoint_message=message.waypoint_message,
        waypoint_problems=_problems_from(message.waypoint_problems),
        presses=tuple(map(_press_from, message.presses)), map_car_id=message.map_car_id,
        log=tuple(robot_status.LogMessage(m.id, m.stamp_s, m.severity, m.source, m.text) for m in message.log),
        notifications=tuple(robot_status.Notification(n.code, n.severity, n.text, _problems_from(n.problems))
                            for n in message.notifications),
        rejected_messages=message.rejected_messages, software_version=message.software_version,
        sent_s=message.sent_time_s, steady_s=_value(message, "steady_time_s", math.nan),
        interventions=robot_status.Interventions(**{name: getattr(message.interventions, name) for name in _COUNTS}),
        emergency_stop=robot_status.EmergencyStop(message.emergency_stop),
        motion_source=robot_status.MotionSource(message.motion_source), hold_id=message.hold_id,
        controller_name=message.controller_name,
        surroundings=surroundings_from(message.surroundings) if message.HasField("surroundings") else None,
        preflight=preflight_from(message.preflight) if message.HasField("preflight") else None,
        waits_for_answer=message.waits_for_answer, simulated=message.simulated,
        area=area_state_from(message.test_area, _problems_from(message.test_area.problems))
        if message.HasField("test_area") else None,
        service=_service_from(message.service_mode) if message.HasField("service_mode") else None)


def _service_from(message: pb.ServiceMode) -> robot_status.ServiceState:
    return robot_status.ServiceState(message.active, message.id, _value(message, "robot_agrees_s", math.nan),
                                     _value(message, "operator_agrees_s", math.nan), _problems_from(message.problems))


def _press_from(message: pb.PressConfirmation) -> robot_status.PressReport:
    return robot_status.PressReport(message.id, message.start_s, message.end_s, message.error,
                                    _problems_from(message.problems))


def status_message_from(status: robot_status.RobotStatus) -> pb.Status:
    """Return the Status message that a robot in this state sends; NaN and None are absent fields."""
    message = pb.Status(
        id=status.id, robot_session_id=status.robot_session_id, state=_state_message(status),
        sent_time_s=status.stamp_s if math.isnan(status.sent_s) else status.sent_s,
        emergency_stop=status.emergency_stop.value, motion_source=status.motion_source.value, hold_id=status.hold_id,
        waits_for_answer=status.waits_for_answer, simulated=status.simulated,
        interventions=pb.Interventions(**{name: getattr(status.interventions, name) for name in _COUNTS}),
        mode=status.mode.value, session_id=status.session_id, command_id=status.command_id,
        waypoint_id=status.waypoint_id, waypoint_result=status.waypoint_result.value,
        waypoint_message=status.waypoint_message,
        waypoint_problems=_problem_messages(status.waypoint_problems), map_car_id=status.map_car_id,
        rejected_messages=status.rejected_messages, software_version=status.software_version,
        presses=[pb.PressConfirmation(id=p.id, start_s=p.start_s, end_s=p.end_s, error=p.error,
                                      problems=_problem_messages(p.problems))
                 for p in status.presses],
        log=[pb.LogMessage(id=m.id, stamp_s=m.stamp_s, severity=m.severity, source=m.source, text=m.text)
             for m in status.log],
        notifications=[pb.Notification(code=n.code, severity=n.severity, text=n.text,
                                       problems=_problem_messages(n.problems)) for n in status.notifications])
    if status.controller_name:
        message.controller_name = status.controller_name
    if not math.isnan(status.steady_s):
        message.steady_time_s = status.steady_s
    if status.car is not None:
        message.car.CopyFrom(_car_message(status.car, status.car_frame))
    if status.car_check is not None:
        _fill_check(message.car_check, status.car_check)
    if status.surroundings is not None:
        message.surroundings.CopyFrom(surroundings_message(status.surroundings))
    if status.area is not None:
        fill_area_state(message.test_area, status.area)
        message.test_area.problems.extend(_problem_messages(status.area.problems))
    if status.service is not None:
        _fill_service(message.service_mode, status.service)
    if status.preflight is not None:
        message.preflight.CopyFrom(preflight_message(status.preflight))
    return message


def _state_message(status: robot_status.RobotStatus) -> pb.RobotState:
    state = pb.RobotState(
        speed=status.speed_mps, yaw_rate_radps=status.yaw_rate_radps, pose_valid=status.pose_valid,
        key_x=status.key_x, key_y=status.key_y, pressed_device_buttons=status.pressed_buttons,
        is_mapping_car=status.is_mapping_car, stamp_s=status.stamp_s)
    for name, value in (("x", status.x), ("y", status.y), ("heading", status.heading),
                        ("device_height", status.key_height_m), ("position_sigma_m", status.position_sigma_m),
                        ("heading_sigma_rad", status.heading_sigma_rad), ("battery_level", status.battery_percent),
                        ("localization_accuracy", status.localization_accuracy_cm),
                        ("variance_x_m2", status.variance_x_m2), ("variance_y_m2", status.variance_y_m2),
                        ("covariance_xy_m2", status.covariance_xy_m2)):
        if value is not None and not math.isnan(value):
            setattr(state, name, value)
    return state


def _car_message(car: robot_status.CarDimensions, frame: robot_status.CarFrame) -> pb.CarDimensions:
    sides = {name: value for name in _SIDE_SIGMAS if not math.isnan(value := getattr(car, name))}
    return pb.CarDimensions(
        **sides, length=car.length, width=car.width, length_sigma=car.length_sigma, width_sigma=car.width_sigma,
        mapped=True,
        outline_x=[x for x, _ in car.outline], outline_y=[y for _, y in car.outline], revision=frame.revision,
        correction_x=frame.correction_x, correction_y=frame.correction_y, correction_heading=frame.correction_heading)


def _fill_check(message: pb.CarCheck, check: robot_status.CarCheck) -> None:
    message.id, message.state, message.message = check.id, check.state.value, check.message
    message.problems.extend(_problem_messages(check.problems))
    for name in _CHECK_FIGURES:
        value = getattr(check, name)
        if not math.isnan(value):
            setattr(message, name, value)


def _fill_service(message: pb.ServiceMode, service: robot_status.ServiceState) -> None:
    message.active, message.id = service.is_active, service.agreement_id
    message.problems.extend(_problem_messages(service.problems))
    for name in ("robot_agrees_s", "operator_agrees_s"):
        if not math.isnan(getattr(service, name)):
            setattr(message, name, getattr(service, name))


def _car_from(car: pb.CarDimensions) -> robot_status.CarDimensions | None:
    if not car.mapped:
        return None
    outline = tuple(zip(car.outline_x, car.outline_y))
    return robot_status.CarDimensions(car.length, car.width, car.length_sigma, car.width_sigma, outline,
                                      *(_value(car, name, math.nan) for name in _SIDE_SIGMAS))


def _frame_from(car: pb.CarDimensions) -> robot_status.CarFrame:
    if not car.mapped:
        return robot_status.CarFrame()
    return robot_status.CarFrame(car.revision, car.correction_x, car.correction_y, car.correction_heading)


def _check_from(check: pb.CarCheck) -> robot_status.CarCheck:
    figures = {name: _value(check, name, math.nan) for name in _CHECK_FIGURES}
    return robot_status.CarCheck(id=check.id, state=robot_status.CheckState(check.state), message=check.message,
                          problems=_problems_from(check.problems), **figures)


def _problems_from(messages: Iterable[pb.Problem]) -> tuple[robot_status.Problem, ...]:
    return tuple(robot_status.Problem(m.code, tuple(zip(m.names, m.values)), m.text) for m in messages)


def _problem_messages(problems: Iterable[robot_status.Problem]) -> list[pb.Problem]:
    return [pb.Problem(code=problem.code, names=[name for name, _ in problem.arguments],
                       values=[value for _, value in problem.arguments], text=problem.text) for problem in problems]


def _value(message: Any, name: str, default: Any) -> Any:
    return getattr(message, name) if message.HasField(name) else default
