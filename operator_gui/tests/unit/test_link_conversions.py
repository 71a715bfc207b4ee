"""Round trips between the link's messages and the domain's types."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from mtr_operator.domain import requests, robot_status
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.robot_status import PreflightItem, PreflightReport
from mtr_operator.robot_link import conversions
from mtr_operator.robot_link.conversions import CommandHeader, UndecodableMessage
from mtr_operator.robot_link.preflight import preflight_from, preflight_message
from mtr_proto import robot_link_pb2 as pb

HEADER = CommandHeader(2 ** 63 - 1, 5, 12.5, seen_status_id=7, seen_robot_time_s=3.25)

DESIRED = [
    requests.DesiredState(),
    requests.DesiredState(stop=True, map_car_id=3),
    requests.DesiredState(check_car_id=4, resume_hold_id=2 ** 62),
    requests.DesiredState(max_speed_mps=0.5, key_height_m=1.25,
                       waypoint=requests.Waypoint(4, Pose(1.5, -2.25, math.pi), requests.Direction.BACKWARD)),
    requests.DesiredState(area=requests.AreaOrder(3, 2 ** 62, ((1.5, -2.5), (4.0, 0.0), (0.0, 3.0)))),
    requests.DesiredState(area=requests.AreaOrder(4, 7, ())),
    requests.DesiredState(stop=True, enters_service=True),
    requests.DesiredState(stop=True, leave_service_id=2 ** 63 - 1),
    requests.DesiredState(press=requests.Press(9, (1, 2), 0.75, 0.5)),
]

LATE = robot_status.Problem("planner.late", (("age_s", "0.6"),), "It is 0.6 s late.")
LOST = robot_status.Problem("planner.lost", (), "Lost. It is 0.6 s late.")

STATUS = robot_status.RobotStatus(
    id=11, robot_session_id=2 ** 62, stamp_s=100.02, x=1.5, y=-0.5, heading=0.25, speed_mps=-0.5, yaw_rate_radps=0.125,
    pose_valid=True, position_sigma_m=0.25, variance_x_m2=0.5, variance_y_m2=0.125,
    covariance_xy_m2=-0.25, heading_sigma_rad=0.0625, key_x=0.25, key_y=0.5, key_height_m=1.0,
    pressed_buttons=(1, 2), localization_accuracy_cm=2, battery_percent=80, is_mapping_car=True,
    mode=robot_status.Mode.MAPPING_CAR,
    car=robot_status.CarDimensions(4.5, 1.75, 0.25, 0.125, ((2.25, 0.5), (-2.25, 0.5), (0.0, -0.875)),
                                   0.109375, 0.078125, 0.03125, 0.0625),
    car_frame=robot_status.CarFrame(3, 0.5, -0.25, 0.125),
    car_check=robot_status.CarCheck(7, robot_status.CheckState.FAILED, 0.25, 0.125, 0.5, 0.0625, "Moved.", (LATE,)),
    session_id=2 ** 63 - 1, command_id=5,
    waypoint_id=4, waypoint_result=robot_status.WaypointResult.REFUSED, waypoint_message="Lost. It is 0.6 s late.",
    waypoint_problems=(LOST, LATE),
    presses=(robot_status.PressReport(1, 2.5, 3.5), robot_status.PressReport(2, 4.5, 4.5, "Servo jammed.", (LATE,))),
    map_car_id=3,
    log=(robot_status.LogMessage(1, 99.5, 2, "lift", "Slow."),),
    notifications=(robot_status.Notification("link_lost", 3, "Lost.", (LOST, LATE)),),
    rejected_messages=6, software_version="1.2", sent_s=100.125, steady_s=50.5,
    interventions=robot_status.Interventions(1, 2, 3, 4, 5, 6, 7),
    emergency_stop=robot_status.EmergencyStop.RELEASED, motion_source=robot_status.MotionSource.MANUAL, hold_id=2 ** 62,
    controller_name="Jana", preflight=PreflightReport(40.5, (PreflightItem("disk", True, "Full."),
                                                              PreflightItem("/imu/data", False, "50 Hz.")), 12, 1),
    waits_for_answer=True, simulated=True,
    area=robot_status.AreaState(True, True, 3, 2 ** 62, ((1.5, -2.5), (4.0, 0.0), (0.0, 3.0)), 2 ** 61,
                                Pose(1.0, 2.0, 0.5), Pose(-1.0, 4.0, -0.25), (LOST, LATE)),
    service=robot_status.ServiceState(True, 2 ** 63 - 1, 59.5, 0.5, (LOST, LATE)))


@pytest.mark.parametrize("desired", DESIRED)
def test_desired_state_survives_the_round_trip(desired):
    payload = conversions.command_from_desired(desired, HEADER).SerializeToString()
    assert conversions.desired_from_command(conversions.decode_command(payload)) == desired


def test_header_is_carried_by_the_command():
    command = conversions.decode_command(conversions.command_from_desired(DESIRED[0], HEADER).SerializeToString())
    assert (command.session_id, command.id, command.sent_time_s) == (2 ** 63 - 1, 5, 12.5)
    assert (command.seen_status_id, command.seen_robot_time_s, command.HasField("end_session")) == (7, 3.25, False)


def test_absent_values_are_absent_fields():
    command = conversions.command_from_desired(requests.DesiredState(), CommandHeader(1, 1, 0.0))
    absent = ("waypoint", "press", "max_speed_mps", "device_height_m", "seen_status_id", "seen_robot_time_s")
    assert not any(command.HasField(name) for name in absent)


def test_status_survives_the_round_trip():
    payload = conversions.status_message_from(STATUS).SerializeToString()
    assert conversions.decode_status(payload) == STATUS


def test_status_without_optional_parts_says_so():
    status = conversions.decode_status(pb.Status(id=1, robot_session_id=2, sent_time_s=3.5).SerializeToString())
    assert status.stamp_s == 3.5
    assert status.car is None and status.battery_percent is None and not status.pose_valid
    assert all(math.isnan(value) for value in (status.x, status.heading, status.key_height_m, status.position_sigma_m))
    assert (status.mode, status.waypoint_result) == (robot_status.Mode.UNKNOWN, robot_status.WaypointResult.NONE)


def test_robot_that_knows_no_check_has_none_and_one_without_figures_has_no_numbers():
    old = pb.Status(id=1, robot_session_id=2, sent_time_s=3.5)
    assert conversions.robot_status_from(old).car_check is None
    assert conversions.robot_status_from(old).car_frame == robot_status.CarFrame()
    old.car_check.limit_m = 0.5
    check = conversions.robot_status_from(old).car_check
    assert (check.id, check.state, check.limit_m) == (0, robot_status.CheckState.NONE, 0.5)
    assert math.isnan(check.difference_m)


def test_time_goes_on_when_the_pose_is_not_valid():
    message = conversions.status_message_from(dataclasses.replace(STATUS, pose_valid=False))
    message.sent_time_s = 105.0
    assert conversions.robot_status_from(message).stamp_s == 105.0


def test_time_of_sending_and_steady_time_are_kept_apart_from_the_pose():  # D7
    message = conversions.status_message_from(STATUS)
    status = conversions.robot_status_from(message)
    assert (status.stamp_s, status.sent_s, status.steady_s) == (100.02, 100.125, 50.5)


def test_robot_of_before_says_nothing_of_interventions_and_holds():
    status = conversions.decode_status(pb.Status(id=1, robot_session_id=2, sent_time_s=3.5).SerializeToString())
    assert status.interventions == robot_status.Interventions() and math.isnan(status.steady_s)
    assert (status.emergency_stop, status.hold_id) == (robot_status.EmergencyStop.UNKNOWN, 0)
    assert status.motion_source is robot_status.MotionSource.UNKNOWN


def test_robot_of_before_says_nothing_of_a_preflight_and_another_that_none_was_made():
    message = pb.Status(id=1, robot_session_id=2, sent_time_s=3.5)
    assert conversions.robot_status_from(message).preflight is None
    message.preflight.SetInParent()
    assert conversions.decode_status(message.SerializeToString()).preflight == PreflightReport()


def test_robot_of_before_says_nothing_of_an_area_and_counts_as_a_real_one():
    status = conversions.decode_status(pb.Status(id=1, robot_session_id=2, sent_time_s=3.5).SerializeToString())
    assert status.area is None and not status.simulated


def test_area_and_pose_that_are_not_finite_are_none():
    message = pb.Status(id=1, robot_session_id=2, sent_time_s=3.5)
    message.test_area.area.CopyFrom(pb.TestArea(id=1, x=[0.0, math.nan, 1.0], y=[0.0, 0.0, 1.0]))
    message.test_area.x, message.test_area.y, message.test_area.heading = 1.0, math.inf, 0.0
    state = conversions.decode_status(message.SerializeToString()).area
    assert state.corners == () and state.robot is None and state.car is None


@pytest.mark.parametrize("motion_made_s", [math.nan, math.inf, -math.inf, None])
def test_time_of_the_preflight_in_motion_survives_the_link_and_one_that_is_none_does_not(motion_made_s):
    report = PreflightReport(8.0, (), 3, 0, 7.5)
    assert preflight_from(preflight_message(report)) == report
    message = pb.PreflightReport(made_s=8.0, checks=3, motion_made_s=motion_made_s)
    assert preflight_from(message) == PreflightReport(8.0, (), 3, 0)


@pytest.mark.parametrize("made_s", [math.nan, math.inf])
def test_preflight_of_no_time_is_none(made_s):
    message = pb.PreflightReport(made_s=made_s, items=[pb.PreflightItem(name="disk")], checks=1, bad=1)
    assert preflight_from(message) == PreflightReport()


def test_preflight_item_that_does_not_say_that_nothing_is_wrong_is_bad():
    message = pb.PreflightReport(made_s=1.0, items=[pb.PreflightItem(name="disk", sentence="Full."),
                                                    pb.PreflightItem(level=pb.SEVERITY_WARNING)] * 40)
    report = preflight_from(message)
    assert len(report.items) == 64 and all(item.is_bad for item in report.items)
    assert (report.checks, report.bad) == (64, 64)


def test_unmapped_car_has_no_dimensions():
    message = conversions.status_message_from(STATUS)
    message.car.mapped = False
    assert conversions.robot_status_from(message).car is None


@pytest.mark.parametrize("payload", [
    b"", b"\xff\xff\xff", b"GET / HTTP/1.1\r\n\r\n", pb.Status(id=1).SerializeToString(),
    pb.Status(id=1, robot_session_id=2, sent_time_s=math.nan).SerializeToString(),
    # An end of a group that nobody has begun, and what would be dropped behind it.
    pb.Status(id=1, robot_session_id=2, sent_time_s=3.0).SerializeToString() + b"\x0c" + b"\x08\x02"])
@pytest.mark.filterwarnings("ignore:Unexpected end-group tag")
def test_other_bytes_are_undecodable(payload):
    with pytest.raises(UndecodableMessage):
        conversions.decode_status(payload)


@pytest.mark.parametrize("message", ["Command", "Status", "RobotState", "CarDimensions", "CarCheck", "Interventions",
                                     "PreflightReport", "PreflightItem", "TestArea", "TestAreaState",
                                     "ServiceMode"])
def test_every_status_field_of_the_proto_is_read(message):
    """A field added to the proto must be thought of here."""
    known = {"Command": 18, "Status": 31, "ServiceMode": 5, "TestArea": 4, "TestAreaState": 11, "RobotState": 19,
             "CarDimensions": 15, "CarCheck": 8, "Interventions": 7, "PreflightReport": 5, "PreflightItem": 3}
    assert len(pb.DESCRIPTOR.message_types_by_name[message].fields) == known[message]
