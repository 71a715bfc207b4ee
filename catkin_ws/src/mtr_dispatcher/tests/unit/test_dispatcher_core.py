"""The dispatcher's core with real protobuf and ROS messages: bytes in, Status out."""
# SPDX-License-Identifier: Apache-2.0
import math

import genpy
import pytest

from mtr_core.requests import Press, Waypoint
from mtr_core.se2 import Pose2
from mtr_dispatcher.command_codec import MAX_MESSAGE_BYTES, UndecodableError, decode
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.session import CommandResult
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_msgs.msg import CarCheck, CarEstimate, LocalizedPose, PeripheralsState, PressReport, Problem, RobotMode
from mtr_proto import robot_link_pb2 as link

NOW_S = 100.0
TOO_NEAR = Problem(code="motion_planner.too_near", text="Too near.")
JAMMED = Problem(code="peripherals.jammed", text="jammed")
MOVED = Problem(code="car_locator.moved", names=["shift_cm"], values=["15"], text="Moved.")


@pytest.fixture
def core():
    dispatcher = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    dispatcher.status(inputs(NOW_S))
    return dispatcher


def inputs(now_s, **known):
    """Return inputs with equal times of both clocks."""
    return Inputs(now_s, steady_s=now_s, **known)


def command_bytes(number=1, session_id=5, **content):
    return link.Command(session_id=session_id, id=number, seen_status_id=1, seen_robot_time_s=NOW_S,
                        **content).SerializeToString()


def status(core, **messages):
    for message in messages.values():
        message.header.stamp = genpy.Time.from_sec(NOW_S)
    return link.Status.FromString(core.status(inputs(NOW_S, **messages)))


def codes(message):
    return {notice.code for notice in message.notifications}


@pytest.mark.parametrize("waits", [False, True])
def test_status_says_whether_time_waits_for_its_answer(waits):
    core = Dispatcher(Parameters(lockstep_operator=waits), Identity(7, "1.2.3", 0.25, 0.0))
    assert status(core).waits_for_answer is waits


def test_command_survives_the_round_trip():
    sent = link.Command(
        session_id=5, id=6, seen_status_id=7, seen_robot_time_s=8.0, stop=True, max_speed_mps=0.5, device_height_m=1.0,
        map_car_id=2, check_car_id=4, watches=True,
        waypoint=link.Waypoint(id=9, x=1.0, y=2.0, heading=3.0, direction=link.DIRECTION_BACKWARD),
        press=link.ButtonPress(id=3, buttons=[1, 2], strength=0.5, duration_s=0.25))
    command = decode(sent.SerializeToString())
    assert (command.session_id, command.id, command.seen_status_id, command.seen_robot_time_s) == (5, 6, 7, 8.0)
    assert (command.stop, command.max_speed_mps, command.key_height_m, command.map_car_id) == (True, 0.5, 1.0, 2)
    assert command.check_car_id == 4 and command.watches
    waypoint, press = command.waypoint, command.press
    assert waypoint == Waypoint(9, "application/5", "car", Pose2(1.0, 2.0, 3.0), 2)
    assert press == Press(3, 5, (1, 2), 0.5, 0.25)


def test_absent_fields_are_the_robots_choice():
    command = decode(link.Command(session_id=5, id=6).SerializeToString())
    assert command.waypoint is command.press is command.max_speed_mps is command.key_height_m is None
    assert math.isnan(command.seen_robot_time_s)


def test_waypoint_without_coordinates_is_not_a_place():
    assert math.isnan(decode(command_bytes(waypoint=link.Waypoint(id=1, x=1.0))).waypoint.pose.y)


# An end-of-group tag without its start: parsers would drop the stop after it.
HALVES = link.Command(session_id=5, id=6), link.Command(stop=True)
CUT_IN_TWO = b"\x0c".join(each.SerializeToString() for each in HALVES)


@pytest.mark.parametrize("data", [b"\xff\xff\xff", b"", b"hello", bytes(MAX_MESSAGE_BYTES + 1), CUT_IN_TWO],
                         ids=["garbage", "empty", "text", "oversized", "cut in two"])
@pytest.mark.filterwarnings("ignore:Unexpected end-group tag")
def test_what_is_no_command_is_counted_and_reported(core, data):
    with pytest.raises(UndecodableError):
        decode(data)
    result, sentence = core.receive(data, NOW_S)
    assert result is None and sentence
    message = status(core)
    assert message.rejected_messages == 1 and "bad_message" in codes(message)


def test_report_of_a_bad_message_disappears_after_a_while(core):
    core.receive(b"\xff", NOW_S)
    later = link.Status.FromString(core.status(inputs(NOW_S + 3.5)))
    assert "bad_message" not in codes(later) and later.rejected_messages == 1


def test_foreign_and_expired_commands_are_counted_and_reported(core):
    core.receive(command_bytes(), NOW_S)
    core.receive(command_bytes(session_id=6), NOW_S)
    core.receive(command_bytes(number=2), NOW_S + 1.5)
    message = status(core)
    assert message.rejected_messages == 2
    assert {"controlled_by_other", "command_expired"} <= codes(message)


def test_notice_of_another_application_is_steady_while_it_is_received_now_and_then(core):
    texts = set()
    for tenth in range(200):
        now_s = NOW_S + 0.1 * tenth
        core.status(inputs(now_s))
        answer = {"id": 1, "seen_status_id": core.status_id, "seen_robot_time_s": now_s}
        core.receive(link.Command(session_id=5, **answer).SerializeToString(), now_s)
        if tenth % 50 == 0:
            core.receive(link.Command(session_id=6, **answer).SerializeToString(), now_s)
        notices = link.Status.FromString(core.status(inputs(now_s))).notifications
        texts.add(tuple(notice.text for notice in notices if notice.code == "controlled_by_other"))
    assert len(texts) == 1 and "Application 5 controls" in texts.pop()[0]
    later = link.Status.FromString(core.status(inputs(NOW_S + 25.5)))
    assert "controlled_by_other" not in codes(later)


def test_notice_of_another_application_ends_when_nobody_controls_the_robot(core):
    core.receive(command_bytes(), NOW_S)
    core.receive(command_bytes(session_id=6), NOW_S)
    assert "controlled_by_other" in codes(status(core))
    core.receive(command_bytes(number=2, end_session=True), NOW_S)
    assert "controlled_by_other" not in codes(status(core))


def test_refused_command_is_a_notification_as_long_as_it_stands(core):
    result, _ = core.receive(command_bytes(max_speed_mps=-1.0), NOW_S)
    assert result is CommandResult.REFUSED
    notice = next(notice for notice in status(core).notifications if notice.code == "command_refused")
    assert "-1 m/s" in notice.text
    core.receive(command_bytes(number=2, max_speed_mps=1.0), NOW_S)
    assert "command_refused" not in codes(status(core))


def test_status_carries_the_pose_in_the_cars_frame(core):
    pose = LocalizedPose(valid=True, x=1.0, y=5.0, heading=math.pi, covariance=[0.0004, 0, 0, 0, 0.0009, 0, 0, 0, 1e-4],
                         speed_mps=0.5)
    car = CarEstimate(state=CarEstimate.LOCATED, x=1.0, y=2.0, heading=math.pi / 2, length=4.5, width=1.8)
    state = status(core, pose=pose, car=car).state
    assert (state.x, state.y) == (pytest.approx(3.0), pytest.approx(0.0, abs=1e-6))
    assert state.heading == pytest.approx(math.pi / 2)
    assert state.position_sigma_m == pytest.approx(0.03) and state.localization_accuracy == 3
    assert (state.variance_x_m2, state.variance_y_m2) == (pytest.approx(0.0009), pytest.approx(0.0004))
    assert state.covariance_xy_m2 == pytest.approx(0.0, abs=1e-9)
    assert state.heading_sigma_rad == pytest.approx(0.01)
    assert state.pose_valid and state.stamp_s == NOW_S and state.speed == 0.5 and state.key_x == 0.25


@pytest.mark.parametrize("valid, car_state", [(False, CarEstimate.LOCATED), (True, CarEstimate.COLLECTING)])
def test_pose_is_not_valid_before_localization_and_car_are(core, valid, car_state):
    assert not status(core, pose=LocalizedPose(valid=valid), car=CarEstimate(state=car_state)).state.pose_valid


def located(**pose):
    """Return a pose and a Car in one map of revision 3, the Car located by mapping order 8."""
    return {"pose": LocalizedPose(valid=True, **{"x": 4.0, "map_revision": 3, **pose}),
            "car": CarEstimate(state=CarEstimate.LOCATED, map_car_id=8, revision=2)}


@pytest.mark.parametrize("revision", [0, 2, 4, 2 ** 32 - 1])
def test_pose_in_another_map_than_the_cars_is_not_valid_and_has_no_place(core, revision):
    assert status(core, **located()).state.pose_valid
    state = status(core, **located(map_revision=revision)).state
    assert not state.pose_valid and not state.HasField("x") and not state.HasField("position_sigma_m")
    # A restarted localization may reuse the old map's number for a new map.
    assert not status(core, **located()).state.pose_valid


def test_pose_is_valid_again_when_the_car_was_mapped_again(core):
    status(core, **located())
    assert not status(core, **located(map_revision=4)).state.pose_valid
    again = located(map_revision=4)
    again["car"].map_car_id = 9
    assert status(core, **again).state.pose_valid


def test_correction_of_the_cars_frame_and_a_silent_part_leave_the_map(core):
    corrected = located()
    corrected["car"].revision = 3
    assert status(core, **located()).state.pose_valid and status(core, **corrected).state.pose_valid
    assert not status(core, pose=located()["pose"]).state.pose_valid
    assert not status(core, car=located()["car"]).state.pose_valid
    assert status(core, **located()).state.pose_valid


def test_map_of_a_car_that_is_being_mapped_does_not_count(core):
    collecting = {**located(map_revision=2), "car": CarEstimate(state=CarEstimate.COLLECTING, map_car_id=8)}
    assert not status(core, **collecting).state.pose_valid
    assert status(core, **located()).state.pose_valid


def test_parts_that_are_silent_tell_nothing(core):
    message = status(core)
    assert not message.HasField("mode") and not message.state.pose_valid
    assert {"state_machine_silent", "peripherals_silent"} <= codes(message)


def test_confirmations_speak_of_the_session_in_control_only(core):
    core.receive(command_bytes(number=3, map_car_id=8), NOW_S)
    order = core.desired(NOW_S).map_order
    presses = [PressReport(session_id=4, id=1), PressReport(session_id=5, id=2, start=genpy.Time(99), error="jammed",
                                                                problems=[JAMMED])]
    mode = RobotMode(mode=RobotMode.FOLLOWING_WAYPOINT, session_id=5, waypoint_id=6, waypoint_result=3,
                     message="Too near.", problems=[TOO_NEAR], map_car_id=order)
    message = status(core, mode=mode, peripherals=PeripheralsState(alive=True, presses=presses, battery=math.nan))
    assert (message.session_id, message.command_id, message.map_car_id) == (5, 3, 8)
    assert (message.waypoint_id, message.waypoint_result) == (6, link.WAYPOINT_RESULT_REFUSED)
    assert message.waypoint_message == "Too near."
    assert [problem.code for problem in message.waypoint_problems] == ["motion_planner.too_near"]
    assert [(press.id, press.start_s, press.error) for press in message.presses] == [(2, 99.0, "jammed")]
    assert message.presses[0].problems[0].code == "peripherals.jammed"
    assert not message.state.HasField("battery_level")


def test_uncertainty_of_each_side_is_passed_on_and_an_unknown_one_is_absent(core):
    car = CarEstimate(state=CarEstimate.LOCATED, length=4.5, width=1.8, front_sigma=0.11, rear_sigma=0.075,
                      left_sigma=0.035, right_sigma=math.nan)
    told = status(core, car=car).car
    assert (told.front_sigma, told.rear_sigma, told.left_sigma) == pytest.approx((0.11, 0.075, 0.035))
    assert not told.HasField("right_sigma")


def test_outline_and_revision_are_told_once_the_car_is_located(core):
    car = CarEstimate(state=CarEstimate.LOCATED, length=4.5, width=1.8, outline_x=[1.0, -1.0, 0.0],
                      outline_y=[0.0, 0.5, -0.5], revision=3, correction_x=0.02, correction_y=-0.01,
                      correction_heading=0.004)
    told = status(core, car=car).car
    assert told.outline_x == [1.0, -1.0, 0.0] and told.outline_y == [0.0, 0.5, -0.5]
    assert told.revision == 3 and told.correction_x == pytest.approx(0.02)
    assert (told.correction_y, told.correction_heading) == (pytest.approx(-0.01), pytest.approx(0.004))
    car.state = CarEstimate.COLLECTING
    assert not status(core, car=car).car.outline_x and not status(core, car=car).car.mapped


def test_check_is_told_to_the_session_that_ordered_it(core):
    core.receive(command_bytes(check_car_id=9), NOW_S)
    order = core.desired(NOW_S).check_order
    check = CarCheck(id=order, state=CarCheck.FAILED, difference_m=0.03, difference_rad=0.002, limit_m=0.02,
                     limit_rad=0.01, message="Moved.", problems=[MOVED])
    told = status(core, check=check).car_check
    assert (told.id, told.state, told.message) == (9, link.CHECK_STATE_FAILED, "Moved.")
    assert [(problem.code, problem.names, problem.values) for problem in told.problems] == [
        ("car_locator.moved", ["shift_cm"], ["15"])]
    assert (told.difference_m, told.limit_m) == (pytest.approx(0.03), pytest.approx(0.02))
    check.difference_m = math.nan
    assert not status(core, check=check).car_check.HasField("difference_m")
    check.id = order + 1
    other = status(core, check=check)
    assert other.HasField("car_check") and not other.car_check.HasField("id")
    assert not status(core).HasField("car_check")


def test_another_sessions_waypoint_is_not_confirmed(core):
    core.receive(command_bytes(), NOW_S)
    message = status(core, mode=RobotMode(mode=4, session_id=4, waypoint_id=6, waypoint_result=2))
    assert not message.HasField("waypoint_id")


def test_fault_and_low_battery_are_notifications(core):
    silent = Problem(code="state_machine.silent", text="The motion planner is silent.")
    message = status(core, mode=RobotMode(mode=RobotMode.FAULT, message=silent.text, problems=[silent]),
                     peripherals=PeripheralsState(alive=True, battery=0.1))
    texts = {notice.code: notice.text for notice in message.notifications}
    assert texts["fault"] == "The motion planner is silent." and "10 %" in texts["low_battery"]
    assert message.state.battery_level == 10
    codes_of = {notice.code: [problem.code for problem in notice.problems] for notice in message.notifications}
    assert codes_of["fault"] == ["state_machine.silent"] and codes_of["low_battery"] == ["dispatcher.low_battery"]


def test_cause_of_a_refusal_follows_it(core):
    core.receive(command_bytes(waypoint=link.Waypoint(id=3, x=200.0, y=0.0, heading=0.0)), NOW_S)
    notice = next(notice for notice in status(core).notifications if notice.code == "command_refused")
    assert [problem.code for problem in notice.problems] == ["dispatcher.command_refused", "dispatcher.waypoint_x"]
    assert notice.problems[1].text == "Waypoint 3: x is 200 m; allowed is -100 to 100 m."
    assert notice.text == notice.problems[0].text == f"Command refused: {notice.problems[1].text}"


def test_log_entry_goes_out_in_ten_status_messages(core):
    core.log.add(1.0, 2, "localization", "slipping")
    core.log.add(1.1, 2, "localization", "slipping")
    sent = [[entry.id for entry in status(core).log] for _ in range(12)]
    assert sent == [[1]] * 10 + [[]] * 2


def test_confirmations_change_with_command_result_and_press(core):
    before = core.confirmed(inputs(NOW_S))
    core.receive(command_bytes(), NOW_S)
    taken = core.confirmed(inputs(NOW_S))
    reached = core.confirmed(inputs(NOW_S, mode=RobotMode(waypoint_result=2)))
    pressed = core.confirmed(inputs(NOW_S, peripherals=PeripheralsState(presses=[PressReport(id=1)])))
    checked = core.confirmed(inputs(NOW_S, check=CarCheck(id=1, state=2)))
    assert taken not in (before, reached, pressed, checked)


@pytest.mark.parametrize("broken", [{"x": math.nan}, {"covariance": [math.inf] + 8 * [0.0]}], ids=["pose", "sigma"])
def test_pose_or_uncertainty_that_is_not_a_number_is_no_pose(core, broken):
    pose, car = LocalizedPose(valid=True, **broken), CarEstimate(state=CarEstimate.LOCATED)
    state = status(core, pose=pose, car=car).state
    assert not state.pose_valid and not state.HasField("x") and not state.HasField("position_sigma_m")


def test_accuracy_is_whole_centimetres_as_far_as_the_field_reaches(core):
    car = CarEstimate(state=CarEstimate.LOCATED)
    poses = [LocalizedPose(valid=True, covariance=[sigma_m ** 2] + 8 * [0.0]) for sigma_m in (1.0, 1e9)]
    assert [status(core, pose=pose, car=car).state.localization_accuracy for pose in poses] == [100, 2 ** 31 - 1]


def test_car_that_nobody_has_located_is_not_mapped(core):
    assert not status(core).car.mapped


@pytest.mark.parametrize("battery, level", [(0.9, 90), (1.5, 100), (-0.5, 0)])
def test_charge_is_a_percentage_between_0_and_100(core, battery, level):
    assert status(core, peripherals=PeripheralsState(alive=True, battery=battery)).state.battery_level == level
