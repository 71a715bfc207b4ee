"""Single cases of the scenarios and their actions, in the world of the other tests."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.pose_history import PoseUnknown
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import LineInvalid, trouble_between
from mtr_operator.domain.errors import ConnectionFailed, LinkLost, RobotFailed
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import (
    CarCheck,
    CarDimensions,
    CarFrame,
    CheckState,
    Notification,
    RobotStatus,
    WaypointResult,
)
from mtr_operator.domain.scenarios.key_press import SCENARIO as KEY_PRESS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
AHEAD = Ray(0.0, 0.0, 1.0, 0.0)
RADIALS = KeyPressParameters.from_mapping({"angle_between_radials_deg": 90.0})


class Listener(RunObserver):
    """Keeps what the loop reports."""

    def __init__(self):
        self.actions, self.silences = [], []

    def on_action(self, text):
        self.actions.append(text)

    def on_link_silent(self, silent_s):
        self.silences.append(silent_s)


@pytest.fixture(name="listener")
def listener_fixture():
    """Watches the loop."""
    return Listener()


@pytest.fixture(name="loop")
def loop_fixture(robot_link, car_link, listener):
    """On the world's links."""
    return ControlLoop(robot_link, car_link, listener)


@pytest.fixture(name="robot")
def robot_fixture(loop):
    """On that loop."""
    return Robot(loop)


# Autolock


# Key press


@pytest.fixture(name="no_passive_entry")
def no_passive_entry_fixture(world):
    """The Car reacts to buttons only."""
    world.unlock_m, world.lock_m = -1.0, -1.0


@pytest.mark.usefixtures("no_passive_entry")
def test_reaction_after_the_end_of_the_press_counts(run_scenario):
    results = run_scenario(KEY_PRESS, replace(RADIALS, press_duration_s=0.05))
    assert [result.distance_m for result in results] == pytest.approx(4 * [5.0])


@pytest.mark.usefixtures("no_passive_entry")
def test_position_that_comes_back_at_the_start_does_not_spoil_the_radial(run_scenario, world):
    begun_s = []

    def lose_position(status):
        if status.waypoint_id == 1 and status.waypoint_result is WaypointResult.REACHED:
            begun_s.append(status.stamp_s)
        is_lost = bool(begun_s) and status.stamp_s < begun_s[0] + 0.5
        return replace(status, pose_valid=status.pose_valid and not is_lost)

    world.spoil = lose_position
    run_scenario(KEY_PRESS, RADIALS)
    assert run_scenario.saved[0][0].status is LineStatus.OK


# Robot


def test_key_height_in_vain_is_named_with_the_one_that_was_reached(robot, spoil):
    spoil(lambda status: True, key_height_m=0.9)
    begun_s = robot.now_s
    with pytest.raises(RobotFailed, match=r"height of 120 cm within 60 s; it is at 90 cm\.$"):
        robot.move_key_to(1.2)
    assert robot.now_s - begun_s == pytest.approx(60.0, abs=0.15)


@pytest.mark.parametrize("wanted_m, height_m, is_there", [
    (1.5, 1.475, True), (1.5, 1.465, False), (0.4, 0.415, True), (0.4, 0.425, False), (1.0, math.nan, False)])
def test_key_is_at_its_height_within_2_percent_or_2_cm(robot, spoil, wanted_m, height_m, is_there):
    spoil(lambda status: True, key_height_m=height_m)
    if is_there:
        robot.move_key_to(wanted_m)
    else:
        with pytest.raises(RobotFailed):
            robot.move_key_to(wanted_m)


def test_a_long_press_is_waited_for_to_its_end(robot):
    press = robot.press(2, 1.0, 8.0)
    assert press.end_s - press.start_s == pytest.approx(8.0)
    assert robot.now_s >= press.end_s


def test_a_press_without_confirmation_is_given_up_10_s_after_its_end(robot, spoil):
    spoil(lambda status: True, presses=())
    begun_s = robot.now_s
    with pytest.raises(LineInvalid, match="within 10 s"):
        robot.press(2, 1.0, 3.0)
    assert robot.now_s - begun_s == pytest.approx(13.0, abs=0.15)


def test_a_waypoint_in_vain_is_given_up_after_180_s_with_the_robots_reason(robot, spoil):
    spoil(lambda status: True, waypoint_result=WaypointResult.PENDING, waypoint_message="Blocked.")
    robot.set_maximum_speed(1.0)
    robot.go_to(AHEAD, 4.0)
    begun_s = robot.now_s
    with pytest.raises(LineInvalid, match=r"within 180 s\. Blocked\.$"):
        robot.wait_until_reached()
    assert robot.now_s - begun_s == pytest.approx(180.0, abs=0.15)


def test_a_refusal_without_a_reason_says_so(robot, spoil):
    spoil(lambda status: True, waypoint_result=WaypointResult.REFUSED)
    robot.set_maximum_speed(1.0)
    robot.go_to(AHEAD, 4.0)
    with pytest.raises(LineInvalid, match=r"refused the waypoint: no reason given\.$"):
        robot.wait_until_reached()


def test_the_result_of_the_former_waypoint_is_not_the_new_ones(robot, loop):
    robot.set_maximum_speed(1.0)
    robot.go_to(AHEAD, 4.0)
    robot.wait_until_reached()
    assert robot.is_at_waypoint()
    robot.go_to(AHEAD, 3.0)
    assert not robot.is_at_waypoint()
    assert loop.desired.waypoint.id == 2 and not loop.desired.stop


def test_waiting_lasts_its_time_and_ends_with_an_answer(robot):
    begun_s = robot.now_s
    assert robot.wait(1.0) is None
    assert robot.now_s - begun_s == pytest.approx(1.0, abs=0.15)
    assert robot.wait(1.0, or_when=lambda: "yes") == "yes"
    assert robot.now_s - begun_s == pytest.approx(1.0, abs=0.15)


def test_a_failed_check_of_the_car_is_an_answer(robot, world, loop):
    robot.stop()
    assert loop.desired.stop
    world.check = CarCheck(state=CheckState.FAILED, message="It moved.")
    assert robot.can_check_car
    assert robot.check_car().message == "It moved."
    assert not loop.desired.stop


def test_the_answer_to_a_former_check_is_not_taken(robot, spoil):
    check = CarCheck(7, CheckState.PASSED)
    spoil(lambda status: True, car_check=check, notifications=(Notification("lost", 2, "It is dark."),))
    begun_s = robot.now_s
    with pytest.raises(RobotFailed, match=r"within 240 s\. It is dark\.$"):
        robot.check_car()
    assert robot.now_s - begun_s == pytest.approx(240.0, abs=0.15)


def test_a_distance_at_an_instant_without_poses_makes_the_line_invalid(robot):
    with pytest.raises(LineInvalid, match="No poses"):
        robot.key_distance(AHEAD, robot.now_s + 1.0, 0.0)


# Preparation and Car


def test_preparation_names_the_keys_height_in_centimetres(loop, robot, listener):
    prepare(loop, robot, Car(loop), 0.5, 1.0)
    assert "move the key to 50 cm" in listener.actions


@pytest.mark.parametrize("lasts_s, is_good", [(8.0, True), (12.0, False)])
def test_the_bus_has_10_s_until_it_is_understood(loop, world, lasts_s, is_good):
    world.car_problem = lambda time_s: "No frame." if time_s < 1.1 + lasts_s else ""
    if is_good:
        Car(loop).prepare()
    else:
        with pytest.raises(ConnectionFailed, match="lock state is unknown: No frame"):
            Car(loop).prepare()


@pytest.mark.parametrize("lasts_s, is_good", [(28.0, True), (32.0, False)])
def test_the_bus_has_30_s_to_recover(loop, world, lasts_s, is_good):
    world.car_problem = lambda time_s: "No frame." if time_s < 1.1 + lasts_s else ""
    if is_good:
        Car(loop).wait_for_bus()
    else:
        with pytest.raises(LinkLost, match="fell silent: No frame"):
            Car(loop).wait_for_bus()


def test_dimensions_before_the_car_is_measured_are_a_mistake_of_the_scenario(loop):
    with pytest.raises(ValueError, match="not awaited"):
        Car(loop).dimensions()


# Control loop and trouble


def test_silence_is_shown_from_the_first_second_on(loop, listener, world):
    loop.step()
    world.spoil = lambda status: None if status.id < 34 else status
    loop.step()
    assert listener.silences == pytest.approx([1.0, 1.2, 1.4, 1.6])


def test_a_robot_that_was_never_ours_is_not_taken_over(loop, spoil):
    spoil(lambda status: True, session_id=0)
    loop.step()
    spoil(lambda status: True, session_id=5, controlled_by_other=True)
    assert loop.step().controlled_by_other


def test_halt_waits_3_s_for_a_robot_that_goes_on_backwards(loop, spoil, robot_link):
    spoil(lambda status: True, speed_mps=-0.5)
    loop.step()
    begun_s = loop.now_s
    assert loop.halt() is False
    assert loop.now_s - begun_s == pytest.approx(3.0, abs=0.15)
    assert robot_link.answers[-1][1].stop


def test_halt_before_the_first_status_stops_nobody(loop):
    assert loop.halt() is None


def test_poses_before_a_restart_are_forgotten(loop, spoil):
    loop.step()
    begun_s = loop.step().stamp_s
    spoil(lambda status: True, robot_session_id=8)
    with pytest.raises(RobotFailed):
        loop.step()
    with pytest.raises(PoseUnknown):
        loop.poses.at(begun_s)


def status(stamp_s=1.0, **changes):
    """A Status of a robot that knows where it is."""
    return replace(RobotStatus(1, 1, stamp_s, x=3.0, y=0.0, heading=0.0, pose_valid=True, position_sigma_m=0.03,
                               heading_sigma_rad=0.01), **changes)


def test_a_new_frame_is_trouble_only_when_the_car_was_known(car_link):
    after = status(1.1, car=CAR, car_frame=CarFrame(2))
    assert "corrected" in trouble_between(status(car=CAR), after, car_link)
    assert trouble_between(status(), after, car_link) == ""
    assert trouble_between(None, after, car_link) == ""


def test_other_notifications_are_no_trouble_of_the_link(car_link):
    assert trouble_between(None, status(notifications=(Notification("battery_low", 2, "Low."),)), car_link) == ""


@pytest.mark.parametrize("code", ["fault", "state_machine_silent"])
def test_a_robot_that_has_a_fault_is_trouble_though_nothing_had_to_stop_it(car_link, code):
    faulty = status(notifications=(Notification(code, 3, "The motion planner is silent."),))
    assert trouble_between(status(), faulty, car_link) == "The robot had a fault: The motion planner is silent."


def test_a_car_that_does_not_say_its_locks_is_trouble(car_link, monkeypatch):
    monkeypatch.setattr(type(car_link), "lock_state", LockState.UNKNOWN)
    assert trouble_between(None, status(), car_link) == "The Car does not say whether it is locked."


# Poses and distances
