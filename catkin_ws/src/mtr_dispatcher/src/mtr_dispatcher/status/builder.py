"""Builds the bytes of a Status from the robot's messages."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, Iterable, NamedTuple, Optional

from mtr_core.problems import problem_of
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Result
from mtr_proto import robot_link_pb2 as link

from ..command_codec import MAX_MESSAGE_BYTES
from ..service.mode import ServiceState
from .area import AreaReport, add_area
from .car_pose import CarPose, UncertainPose, base_in_car
from .inputs import CarFields, CheckFields, Inputs, ModeFields, PeripheralsFields, PoseFields
from .log_buffer import Entry
from .notices import Notice
from .preflight import PREFLIGHT_EVERY, add_preflight
from .service import add_service
from .surroundings import fill
from .texts import cut, problem_messages

MAX_ACCURACY_CM = 2 ** 31 - 1
# Fields of CarEstimate, with the same names in the proto.
_SIDE_SIGMAS = ("front_sigma", "rear_sigma", "left_sigma", "right_sigma")
# Values of DriveStatus.source.
MOTION_SOURCES = {"none": link.MOTION_SOURCE_NONE, "locked": link.MOTION_SOURCE_LOCKED,
                  "manual": link.MOTION_SOURCE_MANUAL, "planner": link.MOTION_SOURCE_PLANNER}
LEFT_OUT = ("surroundings", "preflight", "log", "notifications", "presses")


class Identity(NamedTuple):
    """Constant data of a robot run. The key's position is in base_link, m."""

    robot_session_id: int
    software_version: str
    key_x_m: float
    key_y_m: float


class Confirmations(NamedTuple):
    """Confirmed orders of the session in control."""

    session_id: int
    command_id: int
    map_car_id: int
    check_car_id: int


class Report(NamedTuple):
    """All other contents of one Status.

    Attributes:
        is_one_map: the robot's pose is in the map in which the Car was located.
    """

    status_id: int
    fresh: Inputs
    interventions: Dict[str, int]
    confirmations: Confirmations
    rejected_messages: int
    controller: str
    log: Iterable[Entry]
    notices: Iterable[Notice]
    waits_for_answer: bool
    is_one_map: bool
    simulated: bool
    area: AreaReport
    service: ServiceState


def status_bytes(identity: Identity, report: Report) -> bytes:
    """Return the serialized Status."""
    status = link.Status(
        id=report.status_id, robot_session_id=identity.robot_session_id, sent_time_s=report.fresh.now_s,
        session_id=report.confirmations.session_id, command_id=report.confirmations.command_id,
        map_car_id=report.confirmations.map_car_id, rejected_messages=report.rejected_messages,
        software_version=identity.software_version, steady_time_s=report.fresh.steady_s,
        interventions=link.Interventions(**report.interventions), emergency_stop=report.fresh.emergency_stop,
        waits_for_answer=report.waits_for_answer, simulated=report.simulated)
    add_area(status.test_area, report.fresh, report.area)
    add_service(status.service_mode, report.service)
    status.state.key_x, status.state.key_y = identity.key_x_m, identity.key_y_m
    if report.controller:
        status.controller_name = report.controller
    _add_mode(status, report.fresh.mode, report.confirmations.session_id)
    _add_pose(status.state, report.fresh, report.is_one_map)
    if report.fresh.drive is not None:
        status.motion_source = MOTION_SOURCES.get(report.fresh.drive.source, link.MOTION_SOURCE_UNSPECIFIED)
    _add_car(status.car, report.fresh.car)
    _add_check(status.car_check, report.fresh.check, report.confirmations.check_car_id)
    _add_peripherals(status, report.fresh.peripherals, report.confirmations.session_id)
    for entry in report.log:
        status.log.add(id=entry.id, stamp_s=entry.stamp_s, severity=entry.severity, source=entry.source,
                       text=entry.text)
    for notice in report.notices:
        status.notifications.add(code=notice.code, severity=notice.severity, text=cut(notice.problem.text),
                                 problems=problem_messages(notice.problem))
    if report.fresh.surroundings is not None:
        fill(status.surroundings, report.fresh.surroundings)
    if report.status_id % PREFLIGHT_EVERY == 0:
        add_preflight(status.preflight, report.fresh.preflight)
    return _bounded(status)


def _bounded(status: link.Status) -> bytes:
    """Return the bytes, without optional parts if the Status is too large for the application."""
    data = status.SerializeToString()
    for name in LEFT_OUT:
        if len(data) <= MAX_MESSAGE_BYTES:
            break
        status.ClearField(name)
        data = status.SerializeToString()
    return data


def _add_mode(status: link.Status, mode: Optional[ModeFields], session_id: int) -> None:
    if mode is None:
        return
    status.mode = mode.mode
    status.state.is_mapping_car = mode.mapping
    status.hold_id = mode.hold_id
    if session_id and mode.session_id == session_id and mode.waypoint_id:
        status.waypoint_id, status.waypoint_result = mode.waypoint_id, mode.waypoint_result
        if mode.waypoint_result in (Result.REFUSED, Result.BLOCKED):
            status.waypoint_message = cut(mode.message)
            status.waypoint_problems.extend(problem_messages(problem_of(mode.problems, mode.message)))


def _add_pose(state: link.RobotState, fresh: Inputs, is_one_map: bool) -> None:
    pose = fresh.pose
    state.pose_valid = False
    if pose is None:
        return
    state.stamp_s = pose.header.stamp.to_sec()
    if math.isfinite(pose.speed_mps) and math.isfinite(pose.yaw_rate_radps):
        state.speed, state.yaw_rate_radps = pose.speed_mps, pose.yaw_rate_radps
    # Poses in two maps cannot be compared: the Car's coordinates in one map have no meaning in the other.
    if fresh.car is None or (fresh.car.state == CarState.LOCATED and not is_one_map):
        return
    found = _in_car(pose, fresh.car)
    if not (found.pose.is_finite() and math.isfinite(found.position_sigma_m)):
        return
    state.x, state.y, state.heading = found.pose.x, found.pose.y, found.pose.heading
    state.position_sigma_m, state.heading_sigma_rad = found.position_sigma_m, found.heading_sigma_rad
    state.variance_x_m2, state.variance_y_m2 = found.variance_x_m2, found.variance_y_m2
    state.covariance_xy_m2 = found.covariance_xy_m2
    state.localization_accuracy = min(round(100.0 * found.position_sigma_m), MAX_ACCURACY_CM)
    state.pose_valid = pose.valid and fresh.car.state == CarState.LOCATED


def _in_car(pose: PoseFields, car: CarFields) -> CarPose:
    return base_in_car(UncertainPose(Pose2(pose.x, pose.y, pose.heading), pose.covariance),
                       UncertainPose(Pose2(car.x, car.y, car.heading), car.covariance))


def _add_car(dimensions: link.CarDimensions, car: Optional[CarFields]) -> None:
    dimensions.mapped = False
    if car is None:
        return
    dimensions.length, dimensions.width = car.length, car.width
    dimensions.length_sigma, dimensions.width_sigma = car.length_sigma, car.width_sigma
    for name in _SIDE_SIGMAS:
        if math.isfinite(getattr(car, name)):
            setattr(dimensions, name, getattr(car, name))
    dimensions.mapped = car.state == CarState.LOCATED
    if dimensions.mapped:
        dimensions.outline_x.extend(car.outline_x)
        dimensions.outline_y.extend(car.outline_y)
        dimensions.revision = car.revision
        dimensions.correction_x, dimensions.correction_y = car.correction_x, car.correction_y
        dimensions.correction_heading = car.correction_heading


def _add_check(message: link.CarCheck, check: Optional[CheckFields], check_car_id: int) -> None:
    """Fill the answer to an order of the session in control; the limits are always reported."""
    if check is None:
        return
    message.limit_m, message.limit_rad = check.limit_m, check.limit_rad
    if not check_car_id:
        return
    message.id, message.state, message.message = check_car_id, check.state, cut(check.message)
    message.problems.extend(problem_messages(problem_of(check.problems, check.message)))
    if math.isfinite(check.difference_m):
        message.difference_m, message.difference_rad = check.difference_m, check.difference_rad


def _add_peripherals(status: link.Status, peripherals: Optional[PeripheralsFields], session_id: int) -> None:
    if peripherals is None:
        return
    if math.isfinite(peripherals.key_height_m):
        status.state.device_height = peripherals.key_height_m
    status.state.pressed_device_buttons.extend(peripherals.pressed_buttons)
    if math.isfinite(peripherals.battery):
        status.state.battery_level = round(100.0 * min(max(peripherals.battery, 0.0), 1.0))
    for press in peripherals.presses:
        if session_id and press.session_id == session_id:
            status.presses.add(id=press.id, start_s=press.start.to_sec(), end_s=press.end.to_sec(),
                               error=cut(press.error),
                               problems=problem_messages(problem_of(press.problems, press.error)))
