"""Single cases of the scenarios and their actions, in the world of the other tests."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.distance import Distance, distance_to_outline, position_sigma, recorded_values
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.pose_history import PoseHistory, PoseSample, PoseUnknown
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import LineInvalid, trouble_between
from mtr_operator.domain.errors import ConnectionFailed, LinkLost, RobotFailed
from mtr_operator.domain.geometry.pose import Pose
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
from mtr_operator.domain.scenarios.autolock import SCENARIO as AUTOLOCK
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press import SCENARIO as KEY_PRESS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
AHEAD = Ray(0.0, 0.0, 1.0, 0.0)
AXES = AutolockParameters(measurements_distance_m=10.0, measuring_speed_mps=0.4)
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


def points_of(picture, label):
    """The set of points with this label."""
    return next(points for points in picture.point_sets if points.label == label)


# Autolock


def test_an_axis_takes_the_time_of_its_way_at_the_two_speeds():
    parameters = replace(AXES, straightening_distance_m=0.6, maximum_speed_mps=2.0)
    # 0.6 m at 2 m/s, then from 3.4 m half way to 0.5 m and back at 0.4 m/s.
    assert AUTOLOCK.expected_line_s(parameters) == pytest.approx(0.3 + 2.9 / 0.4)


def test_areas_are_outlines_of_where_the_car_unlocked_and_locked(run_scenario):
    picture = AUTOLOCK.picture(AXES, CAR, run_scenario(AUTOLOCK, AXES))
    unlocked, locked = points_of(picture, "Unlocked"), points_of(picture, "Locked")
    assert unlocked.points[0] == pytest.approx((2.25 + 1.5, 0.0), abs=0.005)
    assert locked.points[0] == pytest.approx((2.25 + 2.5, 0.0), abs=0.005)
    assert unlocked.is_outline and locked.is_outline
    assert len(unlocked.bars) == len(locked.bars) == 8
    assert not any(points_of(picture, label).known for label in ("Unlock not reached", "Lock not reached", "Invalid"))


def test_axes_without_a_reaction_are_marked_where_the_ways_ended(run_scenario, world):
    world.unlock_m = 0.3
    picture = AUTOLOCK.picture(AXES, CAR, run_scenario(AUTOLOCK, AXES))
    assert points_of(picture, "Unlock not reached").points[0] == pytest.approx((2.25 + 0.5, 0.0))
    assert points_of(picture, "Lock not reached").points[0] == pytest.approx((2.25 + 3.5, 0.0))
    assert points_of(picture, "Unlocked").known == ()


def test_a_distance_of_an_invalid_measurement_is_not_part_of_the_area(run_scenario):
    results = run_scenario(AUTOLOCK, AXES)
    results[0] = replace(results[0], unlock_status=LineStatus.INVALID)
    assert points_of(AUTOLOCK.picture(AXES, CAR, results), "Unlocked").points[0] is None


# Key press


@pytest.fixture(name="no_passive_entry")
def no_passive_entry_fixture(world):
    """The Car reacts to buttons only."""
    world.unlock_m, world.lock_m = -1.0, -1.0


def test_a_radial_takes_the_time_of_its_way_and_of_the_presses_to_the_middle_place():
    parameters = replace(RADIALS, maximum_speed_mps=0.5, press_duration_s=0.2, attempts=2)
    # Seven places from 6 m to 3 m: 2 m of way, three places with two presses in vain, one press that works.
    assert KEY_PRESS.expected_line_s(parameters) == pytest.approx(2.0 / 0.5 + 3 * 2 * (0.5 + 1.0) + 0.5)


def test_the_nearest_place_may_leave_exactly_the_clearance():
    assert len(KEY_PRESS.lines(replace(RADIALS, clearance_m=0.75), CAR)) == 4


def test_radials_may_be_shown_before_the_car_is_measured():
    assert KEY_PRESS.lines_stay and not AUTOLOCK.lines_stay


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


@pytest.mark.usefixtures("no_passive_entry")
def test_outline_encloses_what_worked_and_an_invalid_radial_is_marked_at_its_first_place(run_scenario):
    results = run_scenario(KEY_PRESS, RADIALS)
    results[0] = replace(results[0], status=LineStatus.INVALID, distance_m=None)
    worked, failed, _, invalid = KEY_PRESS.picture(RADIALS, CAR, results).point_sets
    assert (worked.is_outline, failed.is_outline, invalid.is_outline) == (True, False, False)
    assert invalid.known == (pytest.approx((6.0, 0.0)),)
    assert worked.points[0] is None and len(worked.bars) == 3


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


def test_a_car_that_does_not_say_its_locks_is_trouble(car_link, monkeypatch):
    monkeypatch.setattr(type(car_link), "lock_state", LockState.UNKNOWN)
    assert trouble_between(None, status(), car_link) == "The Car does not say whether it is locked."


# Poses and distances


def test_poses_are_remembered_for_a_minute():
    poses = PoseHistory()
    for index in range(701):
        poses.add(status(1.0 + index / 10))
    with pytest.raises(PoseUnknown, match=r"No poses .* 10\.900 s"):
        poses.at(10.9)
    assert poses.at(11.15).stamp_s == 11.15


def test_a_pose_older_than_the_newest_is_not_remembered():
    poses = PoseHistory()
    for stamp_s, x in ((1.0, 3.0), (1.2, 3.2), (1.1, 9.0)):
        poses.add(status(stamp_s, x=x))
    assert poses.at(1.1).pose.x == pytest.approx(3.1)


def test_a_pose_between_two_has_the_worse_accuracy_and_the_mean_speed():
    poses = PoseHistory()
    poses.add(status(1.0, speed_mps=0.2, position_sigma_m=0.05, heading_sigma_rad=0.01))
    poses.add(status(1.5, speed_mps=0.4, position_sigma_m=0.03, heading_sigma_rad=0.02, x=4.0))
    sample = poses.at(1.25)
    assert (sample.pose.x, sample.speed_mps) == pytest.approx((3.5, 0.3))
    assert (sample.position_sigma_m, sample.heading_sigma_rad) == (0.05, 0.02)


@pytest.mark.parametrize("covariance, sigma_m", [
    ((0.04, 0.01, 0.01), math.sqrt(0.36 * 0.04 + 0.64 * 0.01 + 2 * 0.48 * 0.01)),
    ((0.04, 0.01, math.nan), 0.03), ((0.0, 0.0, -0.01), 0.0)])
def test_position_counts_along_the_ray_or_in_its_worst_direction(covariance, sigma_m):
    sample = PoseSample(1.0, Pose(3.0, 0.0, 0.0), 0.0, 0.03, 0.01, 0.25, 0.0, covariance)
    assert position_sigma(Ray(0.0, 0.0, 0.6, 0.8), sample) == pytest.approx(sigma_m)


@pytest.mark.parametrize("ray, distance_m, gap_m", [
    (Ray(0.0, 0.0, 1.0, 0.0), 3.25, 1.0), (Ray(0.0, 0.0, 0.0, -1.0), 1.9, 1.0), (Ray(0.0, 0.0, -1.0, 0.0), 2.0, 0.0),
    (Ray(2.25, 0.9, 0.6, 0.8), 5.0, 5.0)])
def test_distance_to_the_outline_is_that_of_the_nearest_side_or_corner(ray, distance_m, gap_m):
    assert distance_to_outline(ray, distance_m, CAR) == pytest.approx(gap_m)


def test_distances_are_recorded_to_micrometres_and_microseconds():
    assert recorded_values(Distance(1.23456789, 0.01234567, 12.3456789)) == (1.234568, 0.012346, 12.345679)
    assert recorded_values(Distance(1.0, math.nan, 2.0)) == (1.0, None, 2.0)
    assert recorded_values(None) == (None, None, None)
