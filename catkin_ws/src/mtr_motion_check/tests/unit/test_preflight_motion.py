"""Scans, wheels and IMU of the same motion; mtr_benchmarks tests whole drives on faulty robots."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_core.se2 import Pose2
from mtr_description.shipped import shipped_geometry
from mtr_motion_check.advance import Witnesses, advance_findings
from mtr_motion_check.finding import NEEDS_MORE, bad, good, needs_more
from mtr_motion_check.fits import ratio
from mtr_motion_check.inertia import Thrust, gravity, thrust
from mtr_motion_check.judge import MotionJudge, is_finished, up_findings
from mtr_motion_check.matching import match, moved
from mtr_motion_check.recording import (
    ImuSample,
    Recording,
    ScanSample,
    Sweep,
    WheelSample,
    scan_sample,
)
from mtr_motion_check.steps import Step, Steps, gyro_between, wheels_between
from mtr_motion_check.swap import aside_when_swapped, lever_says_swapped
from mtr_motion_check.turning import turn_findings, turns

MOUNTS = shipped_geometry().lidars()
ALONE = MOUNTS._replace(rear=None)
SILENT = Witnesses(None, False)
FORWARD_FELT, BACKWARD_FELT = (Witnesses(Thrust(sign, 0.0, 0.05), False) for sign in (1.0, -1.0))


def room(pose, noise=None):
    """Return points of a room of 8 m by 6 m with a pillar, as seen by a LiDAR at the pose."""
    along, across = np.linspace(-4.0, 4.0, 160), np.linspace(-3.0, 3.0, 120)
    walls = [np.column_stack([along, np.full(160, side)]) for side in (-3.0, 3.0)]
    walls += [np.column_stack([np.full(120, side), across]) for side in (-4.0, 4.0)]
    pillar = np.array([2.0, 1.0]) + 0.2 * np.column_stack([np.cos(along * 0.7), np.sin(along * 0.7)])
    points = moved(np.concatenate([*walls, pillar]), pose.inverse())
    return points if noise is None else points + noise.normal(0.0, 0.01, points.shape)


@pytest.mark.parametrize("motion", [Pose2(0.0, 0.0, 0.0), Pose2(0.35, 0.0, 0.0), Pose2(-0.4, 0.02, 0.1),
                                    Pose2(0.05, 0.03, 0.7), Pose2(0.1, -0.1, -0.75), Pose2(0.0, 0.3, 0.0)])
def test_motion_between_two_scans_is_found_without_a_guess(motion):
    noise, start = np.random.default_rng(1), Pose2(-0.5, 0.4, 0.3)
    found = match(room(start, noise), room(start @ motion, noise))
    assert found is not None
    assert found.distance_to(motion) < 0.01 and abs(found.heading - motion.heading) < 0.005


def test_bare_wall_and_empty_scan_tell_nothing():
    wall = np.column_stack([np.linspace(-5.0, 5.0, 300), np.full(300, 2.0)])
    assert match(wall, wall) is None
    assert match(np.zeros((0, 2)), room(Pose2(0.0, 0.0, 0.0))) is None


def test_scan_of_another_place_is_no_match():
    noise = np.random.default_rng(2)
    assert match(room(Pose2(0.0, 0.0, 0.0)), noise.uniform(-10.0, 10.0, (500, 2))) is None


def test_scan_sample_leaves_out_what_hit_nothing_and_has_the_time_of_the_middle():
    ranges = np.array([1.0, np.inf, np.nan, -np.inf, 0.05, 31.0, 2.0])
    sample = scan_sample(Sweep(10.0, 0.0, math.pi / 6.0, 0.01, 0.1, 30.0, ranges))
    assert sample.time_s == pytest.approx(10.035)
    assert sample.points_m == pytest.approx(np.array([[1.0, 0.0], [-2.0, 0.0]]))


def test_ratio_is_not_led_astray_by_one_step_and_knows_its_error():
    known = [0.2] * 5 + [-0.2] * 4 + [0.0] * 3
    said = [1.1 * value + 0.001 * (-1) ** index for index, value in enumerate(known)]
    found = ratio(known, [*said[:3], 0.7, *said[4:]])
    assert found.value == pytest.approx(1.1, abs=0.01) and found.sigma < 0.01
    assert found.differs(1.0, 0.05) and not found.differs(1.1, 0.05)


def test_ratio_beside_a_constant():
    known, durations = [0.0, 0.0, 0.3, 0.4, -0.3], [0.5, 0.5, 0.5, 0.6, 0.5]
    said = [0.9 * value + 0.05 * duration for value, duration in zip(known, durations)]
    assert ratio(known, said, durations).value == pytest.approx(0.9)
    assert ratio(known[:2], said[:2]) is None


def test_wheels_and_gyro_between_two_times():
    wheels = [WheelSample(0.02 * index, 0.5, 1.0) for index in range(1, 101)]
    pose = wheels_between(wheels, 0.5, 1.5)
    assert pose.heading == pytest.approx(1.0)
    assert (pose.x, pose.y) == pytest.approx((0.5 * math.sin(1.0), 0.5 * (1.0 - math.cos(1.0))), abs=1e-4)
    imu = [ImuSample(0.02 * index, (0.0, 0.0, 0.3), (0.0, 0.0, 9.81)) for index in range(101)]
    assert gyro_between(imu, 0.511, 1.511) == pytest.approx(0.3)
    assert gyro_between(imu, 1.5, 2.5) is None and gyro_between([], 0.0, 1.0) is None


def driven(felt_x=1.0, felt_y=0.0):
    """Return two starts and stops at 1 m/s2; the accelerometer measures these shares of it along its axes."""
    recording, speed = Recording(), 0.0
    for index in range(300):
        gain = {0: 1.0, 1: -1.0}.get(index // 25 % 6, 0.0)
        speed += 0.02 * gain
        recording.wheels.append(WheelSample(0.02 * index, speed, 0.0))
        recording.imu.append(ImuSample(0.02 * index, (0.0, 0.0, 0.0), (felt_x * gain, felt_y * gain, 9.81)))
    return recording


@pytest.mark.parametrize("felt, angle", [((1.0, 0.0), 0.0), ((-1.0, 0.0), math.pi), ((0.0, 1.0), math.pi / 2.0)])
def test_direction_of_setting_off_is_felt(felt, angle):
    assert thrust(driven(*felt)).angle_rad == pytest.approx(angle, abs=0.01)


def test_accelerometer_has_no_opinion_of_a_robot_that_stands_or_of_noise():
    standing = Recording(wheels=[WheelSample(0.02 * index, 0.0, 0.0) for index in range(300)], imu=driven().imu)
    assert thrust(standing) is None and thrust(Recording()) is None
    noise = np.random.default_rng(3).normal(0.0, 5.0, (300, 2))
    shaken = [ImuSample(each.time_s, each.rate_radps, (*push, 9.81)) for each, push in zip(driven().imu, noise)]
    assert thrust(Recording(wheels=driven().wheels, imu=shaken)) is None


@pytest.mark.parametrize("force, is_bad, text", [
    ((0.3, 0.1, 9.8), False, "Up is 1.8 deg"), ((0.0, 9.81, 0.0), True, "Up is +y of the IMU, 90 deg"),
    ((0.0, 0.0, -9.81), True, "Up is -z of the IMU, 180 deg"), ((0.0, 0.0, 1.0), True, "says 1.00 m/s2"),
    ((math.nan, 0.0, 9.81), True, "says nan m/s2"), ((0.0, 0.0, 0.0), True, "says 0.00 m/s2")])
def test_gravity_is_along_z(force, is_bad, text):
    finding, = up_findings(gravity([ImuSample(0.0, (0.0, 0.0, 0.0), force)]))
    assert finding.is_bad is is_bad and text in finding.text


def test_silent_imu_is_bad():
    assert up_findings(gravity([]))[0].is_bad


AHEAD, BEHIND, UPSIDE_DOWN = Pose2(1.0, 0.0, 0.0), Pose2(-1.0, 0.0, 0.0), Pose2(1.0, 0.0, -2.0)


def steps(front=AHEAD, rear=AHEAD, gyro=1.0, wheels=(1.0, 1.0), lever=0.0):
    """Forward, back and a turn: x and y by a LiDAR for each metre driven, and its rotation for each rad."""
    def seen(lidar, way, turn):
        return lidar and Pose2(lidar.x * way, lidar.y * way + lever * turn, turn * (1.0 + lidar.heading))
    legs = [(0.2, 0.0)] * 4 + [(-0.2, 0.0)] * 4 + [(0.0, 0.3)] * 4 + [(0.0, 0.0)] * 2
    return [Step(0.5, Pose2(wheels[0] * way, 0.0, wheels[1] * turn), seen(front, way, turn), seen(rear, way, turn),
                 gyro * turn + 0.01) for way, turn in legs]


def advance_text(made, mounts=MOUNTS, witnesses=SILENT):
    return " ".join(finding.text for finding in advance_findings(made, mounts, witnesses) if finding.is_bad)


def test_right_robot_passes():
    made = steps()
    assert advance_text(made) == "" and not any(finding.is_bad for finding in turn_findings(made, turns(made), True))


@pytest.mark.parametrize("witnesses, text", [
    (FORWARD_FELT, "LiDAR are swapped"), (BACKWARD_FELT, "odometry has the wrong sign"),
    (Witnesses(None, True), "odometry has the wrong sign"), (Witnesses(Thrust(1.0, 0.0, 0.05), True), "wrong sign")])
def test_which_is_reversed_is_told_by_accelerometer_and_turn(witnesses, text):
    assert text in advance_text(steps(BEHIND, BEHIND), MOUNTS, witnesses)


def test_levers_tell_which_is_reversed_where_nothing_else_does():
    lever = aside_when_swapped(MOUNTS)
    assert lever == pytest.approx(0.08)
    assert "are swapped" in advance_text(steps(BEHIND, BEHIND, lever=lever))
    assert "odometry has the wrong sign" in advance_text(steps(BEHIND, BEHIND, lever=0.005))
    assert lever_says_swapped(steps()[:8], MOUNTS) is None and lever_says_swapped(steps(), ALONE) is None


def test_without_turn_and_push_both_causes_are_named():
    found, = advance_findings(steps(BEHIND, BEHIND)[:8], MOUNTS, SILENT)
    assert found.check == NEEDS_MORE and "either the odometry" in found.text and "exchanged" in found.text


def test_single_lidar_that_looks_back_is_named():
    assert "front_lidar is turned by 180 deg" in advance_text(steps(BEHIND, None), ALONE, FORWARD_FELT)


@pytest.mark.parametrize("front, rear, text", [
    (BEHIND, AHEAD, "front_lidar saw the robot go 180 deg aside"),
    (AHEAD, BEHIND, "rear_lidar saw the robot go 180 deg aside"),
    (Pose2(0.985, 0.174, 0.0), AHEAD, "turned by -10 deg against robot_description"),
    (Pose2(0.9, 0.0, 0.0), Pose2(0.9, 0.0, 0.0), "The wheels say 1.11 times the way"),
    (Pose2(1.06, 0.0, 0.0), Pose2(0.95, 0.0, 0.0), "which LiDAR measures ranges wrongly")])
def test_lidar_or_wheels_that_differ_are_named(front, rear, text):
    assert text in advance_text(steps(front, rear))


@pytest.mark.parametrize("scale, is_bad", [(1.0, False), (1.04, False), (0.96, False), (1.07, True), (0.94, True)])
def test_scale_of_the_wheels_has_five_percent(scale, is_bad):
    assert bool(advance_text(steps(wheels=(scale, 1.0)))) is is_bad


def test_wheels_that_do_not_count_are_told():
    assert "keeps the base from counting" in advance_text(steps(wheels=(0.0, 0.0)))


def test_too_short_a_way_and_a_blind_lidar_ask_for_different_things():
    assert advance_text(steps()[:2]).count("drive 1 m forward") == 1
    assert "what covers the LiDAR" in advance_text(steps(rear=None))


def turn_text(made, z_is_up=True):
    return " ".join(finding.text for finding in turn_findings(made, turns(made), z_is_up) if finding.is_bad)


@pytest.mark.parametrize("made, text", [
    (steps(gyro=-1.0), "the IMU is mounted upside down"), (steps(gyro=0.0), "IMU is mounted turned or its scale"),
    (steps(gyro=1.1), "The gyro says 1.100 times"), (steps(wheels=(1.0, -1.0)), "left and right wheels are exchanged"),
    (steps(wheels=(1.0, 1.4)), "correct the track"), (steps()[:8], "turn by 90 deg"),
    (steps(front=UPSIDE_DOWN), "front_lidar sees the robot turn the other way than the other"),
    (steps(rear=UPSIDE_DOWN), "rear_lidar sees the robot turn the other way than the other"),
    (steps(front=UPSIDE_DOWN, rear=None), "front_lidar sees the robot turn the other way than gyro and wheels")])
def test_wrong_turn_names_who_is_wrong(made, text):
    assert text in turn_text(made)


def test_gyro_that_sees_nothing_of_a_turn_does_not_tell_which_lidar_is_upside_down():
    made = steps(gyro=0.0)
    made = [replace(step, gyro_rad=-0.01 * (step.front.heading > 0.0)) for step in made]
    assert "IMU is mounted turned or its scale" in turn_text(made)
    assert "upside down" not in turn_text([replace(step, rear=step.rear and replace(step.rear, heading=0.0))
                                           for step in made])


def test_gyro_and_wheels_are_wrong_when_gravity_says_that_the_imu_is():
    text = turn_text(steps(gyro=-1.0, wheels=(-1.0, -1.0)), z_is_up=False)
    assert "IMU is mounted upside down" in text and "odometry has the wrong sign" in text


def test_drive_ends_when_all_is_good_or_nothing_more_is_learnt():
    fine, wrong, short = good("a", "b", "c"), bad("a", "b", "c"), needs_more("b", "c")
    assert is_finished([fine], 0.0) and is_finished([wrong], 5.0)
    assert not is_finished([wrong], 4.9) and not is_finished([wrong, short], 19.0)


def robot_in_room(rear_late_s=0.0, imu_until_s=9.0):
    """Return a robot at rest for a second, then driving 0.4 m/s in a room, with asynchronous LiDARs."""
    recording = Recording()
    for index in range(250):
        time_s = 0.02 * index
        speed = 0.4 if time_s > 1.0 else 0.0
        recording.wheels.append(WheelSample(time_s, speed, 0.0))
        if time_s <= imu_until_s:
            recording.imu.append(ImuSample(time_s, (0.0, 0.0, 0.0), (0.0, 0.0, 9.81)))
        if index % 2 == 0:
            for scans, mount, late_s in ((recording.front, MOUNTS.front, 0.0),
                                         (recording.rear, MOUNTS.rear, rear_late_s)):
                place = Pose2(0.4 * max(0.0, time_s + late_s - 1.0) - 1.0, 0.0, 0.0)
                scans.append(ScanSample(time_s + late_s, room(place @ mount)))
    return recording


def test_steps_wait_for_the_slowest_sensor_and_are_made_once():
    recording, made = robot_in_room(), Steps(MOUNTS)
    made.extend(recording.until(1.6))
    assert len(made.made) == 2
    made.extend(recording)
    assert len(made.made) == 9 and made.made[0].wheels.x == 0.0 and made.made[2].wheels.x == pytest.approx(0.208)


def test_lidar_that_turns_out_of_step_or_loses_scans_sees_the_same_way():
    recording, made = robot_in_room(rear_late_s=0.017), Steps(MOUNTS)
    recording.rear = [scan for index, scan in enumerate(recording.rear) if index % 13 != 12]
    made.extend(recording)
    moving = made.made[3:]
    assert [step.front.x for step in moving] == pytest.approx([0.2] * len(moving), abs=0.012)
    assert [step.rear.x for step in moving] == pytest.approx([step.wheels.x for step in moving], abs=0.012)


def test_imu_that_falls_silent_leaves_steps_without_gyro():
    made = Steps(MOUNTS)
    made.extend(robot_in_room(imu_until_s=2.0))
    assert made.made[0].gyro_rad == 0.0 and made.made[-1].gyro_rad is None


def test_right_robot_that_only_drives_ahead_is_asked_for_a_turn():
    found = MotionJudge(MOUNTS).findings(robot_in_room())
    assert [finding.check for finding in found if finding.is_bad] == [NEEDS_MORE]
    assert robot_in_room().motion_start_s() == pytest.approx(1.02)
    assert robot_in_room().motion_s() == pytest.approx(3.96, abs=0.03)


def test_robot_without_rear_lidar_is_judged_by_the_front_one():
    recording = robot_in_room()
    recording.rear = []
    found = MotionJudge(ALONE).findings(recording)
    assert [finding.check for finding in found if finding.is_bad] == [NEEDS_MORE]
    assert any("that front_lidar saw" in finding.text for finding in found)
