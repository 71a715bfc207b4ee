"""The benchmark's errors are those that were injected, and its covariances are evaluated correctly."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_benchmarks.localization.drives.pose_track import aligned, at, compose, pose_track
from mtr_benchmarks.localization.drives.sensor_log import SensorLog, Sweep
from mtr_benchmarks.localization.drives.truth import DriveTruth
from mtr_benchmarks.localization.methods import mrpt
from mtr_benchmarks.localization.methods.compared import fitted_car
from mtr_benchmarks.localization.methods.dead_reckoning import dead_reckoned
from mtr_benchmarks.localization.methods.errors import MeasuredCar, errors_of, joined, percentile, whitened_errors
from mtr_core.se2 import Pose2

STAMPS = np.arange(0.0, 20.0, 0.02)
MAP_FROM_CAR = Pose2(-3.0, 1.5, 0.7)
NO_COVARIANCE = np.zeros((3, 3))


def truth_of(poses_in_car, judged_from_s=0.0):
    """Return the truth of a drive whose first half is the loop."""
    count = len(poses_in_car)
    meta = {"map_from_car": {"x_m": -3.0, "y_m": 1.5, "heading_rad": 0.7},
            "segments": [{"kind": "loop", "begin_s": -1.0, "end_s": 10.0}]}
    return DriveTruth(pose_track(STAMPS, poses_in_car), np.zeros(count, bool), np.zeros(count, bool), np.zeros(count),
                      judged_from_s <= STAMPS, meta)


def circle():
    """Return poses around the Car."""
    angles = STAMPS / 20.0 * 2.0 * math.pi
    return np.stack([4.0 * np.cos(angles), 3.0 * np.sin(angles), angles + math.pi / 2.0], axis=1)


def test_perfect_method_has_no_error():
    track = pose_track(STAMPS, compose(MAP_FROM_CAR, circle()))
    errors = errors_of(track, MeasuredCar(MAP_FROM_CAR, NO_COVARIANCE), truth_of(circle()))
    assert np.max(errors.key_m) < 1e-9
    assert np.max(np.abs(errors.yaw_deg)) < 1e-9


def test_car_that_is_found_beside_its_place_moves_every_key():
    track = pose_track(STAMPS, compose(MAP_FROM_CAR, circle()))
    beside = MeasuredCar(MAP_FROM_CAR @ Pose2(0.03, -0.04, 0.0), NO_COVARIANCE)
    assert errors_of(track, beside, truth_of(circle())).key_m == pytest.approx(0.05)


def test_wrong_heading_moves_the_key_by_its_lever():
    poses = circle() + (0.0, 0.0, 0.02)
    errors = errors_of(pose_track(STAMPS, compose(MAP_FROM_CAR, poses)), MeasuredCar(MAP_FROM_CAR, NO_COVARIANCE),
                       truth_of(circle()))
    assert errors.key_m == pytest.approx(0.25 * 0.02, rel=1e-3)
    assert errors.yaw_deg == pytest.approx(math.degrees(0.02))


@pytest.mark.parametrize("silent", [slice(700, None), slice(300, 600), slice(0, 300)])
def test_method_that_says_nothing_does_not_know_its_pose(silent):
    said = np.ones(len(STAMPS)) > 0.0
    said[silent] = False
    track = pose_track(STAMPS[said], compose(MAP_FROM_CAR, circle())[said], np.tile(np.eye(3), (sum(said), 1, 1)),
                       np.ones(sum(said)) > 0.0)
    errors = errors_of(track, MeasuredCar(MAP_FROM_CAR, NO_COVARIANCE), truth_of(circle()))
    assert len(errors.key_m) == len(STAMPS)
    assert np.mean(np.isnan(errors.key_m)) == pytest.approx(np.mean(~said), abs=0.011)
    assert np.isnan(errors.whitened[np.isnan(errors.key_m)]).all()


def test_pose_that_is_not_valid_is_unknown_and_not_good():
    valid = np.ones(len(STAMPS))
    valid[500:] = 0.0
    covariances = np.tile(1e-4 * np.eye(3), (len(STAMPS), 1, 1))
    track = pose_track(STAMPS, compose(MAP_FROM_CAR, circle()), covariances, valid > 0.5)
    errors = errors_of(track, MeasuredCar(MAP_FROM_CAR, NO_COVARIANCE), truth_of(circle()))
    for values in (errors.key_m, errors.nees, errors.whitened[:, 0]):
        assert np.isnan(values[500:]).all() and not np.isnan(values[:500]).any()


def test_only_what_comes_after_the_loop_is_judged():
    track = pose_track(STAMPS, compose(MAP_FROM_CAR, circle()))
    errors = errors_of(track, MeasuredCar(MAP_FROM_CAR, NO_COVARIANCE), truth_of(circle(), judged_from_s=15.0))
    assert errors.stamps_s[0] == pytest.approx(15.0)


def test_normalised_error_of_honest_covariances_has_its_expectation():
    noise = np.random.default_rng(1)
    robot = np.array(((4e-4, 1e-4, 0.0), (1e-4, 9e-4, 1e-5), (0.0, 1e-5, 1e-4)))
    car = np.diag((1e-4, 2e-4, 4e-6))
    true_in_car = np.tile((6.0, -2.0, 2.5), (20_000, 1))
    robots = compose(MAP_FROM_CAR, true_in_car) + noise.multivariate_normal(np.zeros(3), robot, 20_000)
    cars = noise.multivariate_normal(np.zeros(3), car, 20_000)
    measured = np.array([compose((Pose2(MAP_FROM_CAR.x + x, MAP_FROM_CAR.y + y, MAP_FROM_CAR.heading + h)).inverse(),
                                 row[np.newaxis])[0] for (x, y, h), row in zip(cars, robots)])
    covariances = joined(np.tile(robot, (20_000, 1, 1)), MeasuredCar(MAP_FROM_CAR, car), true_in_car)
    squares = np.sum(whitened_errors(measured, true_in_car, covariances) ** 2, axis=1)
    assert np.mean(squares) == pytest.approx(3.0, rel=0.05)


def test_percentile_leaves_unknown_values_out_and_knows_none_of_none():
    assert percentile(np.array([1.0, math.nan, 3.0]), 50.0) == pytest.approx(2.0)
    assert percentile(np.array([math.nan])) is None


def test_alignment_finds_the_motion_between_two_tracks():
    motion = Pose2(5.0, -2.0, 2.9)
    found = aligned(circle(), compose(motion, circle()))
    assert (found.x, found.y, found.heading) == pytest.approx((5.0, -2.0, 2.9))


def test_method_without_locator_is_given_the_car_by_its_loop():
    poses = compose(Pose2(7.0, 8.0, -1.0), circle())
    car = fitted_car(pose_track(STAMPS, poses), truth_of(circle())).pose
    assert (car.x, car.y, car.heading) == pytest.approx((7.0, 8.0, -1.0))


def test_headings_are_interpolated_across_the_half_turn():
    track = pose_track(np.array([0.0, 1.0]), np.array([(0.0, 0.0, 3.1), (0.0, 0.0, -3.1)]))
    assert at(track, np.array([0.5]))[0, 2] == pytest.approx(math.pi)


def test_dead_reckoning_takes_the_gyro_s_bias_off_after_standing():
    speeds = np.where(STAMPS < 4.0, 0.0, 0.5)
    rates = np.where(STAMPS < 4.0, 0.0, 0.3) + 0.005
    track = dead_reckoned(SensorLog(np.stack([STAMPS, speeds], axis=1), np.stack([STAMPS, rates], axis=1), []))
    driven_s = STAMPS[-1] - 4.0 + 0.02
    assert track.poses[-1, 2] == pytest.approx(0.3 * driven_s, abs=0.01)
    radius = 0.5 / 0.3
    end = math.sin(0.3 * driven_s) * radius, (1.0 - math.cos(0.3 * driven_s)) * radius
    assert tuple(track.poses[-1, :2]) == pytest.approx(end, abs=0.03)


def sweep_of_a_wall(turning_radps):
    """Return a sweep of a wall at x = 3 from a rotating robot at the origin; its LiDAR is at (0.1, 0)."""
    stamps = 1.0 + np.linspace(0.0, 0.03, 200)
    angles = np.linspace(-0.8, 0.8, 200)
    headings = turning_radps * (stamps - 1.0)
    places = np.stack([0.1 * np.cos(headings), 0.1 * np.sin(headings)], axis=1)
    ranges = (3.0 - places[:, 0]) / np.cos(angles + headings)
    return Sweep(stamps, angles, 0.1, ranges)


def test_sweep_of_a_turning_robot_is_straightened():
    odometry = pose_track(np.array([1.0, 1.03]), np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.06)]))
    end = np.array((0.0, 0.0, 0.06))
    seen = mrpt.points(sweep_of_a_wall(2.0), odometry, end)
    assert compose(Pose2(*end), np.column_stack([seen, np.zeros(len(seen))]))[:, 0] == pytest.approx(3.0, abs=1e-6)


def test_rebinned_scan_keeps_the_nearest_return_of_a_direction():
    ranges = mrpt.rebinned([np.array([(2.0, 0.0), (1.0, 0.0)]), np.array([(0.0, -4.0)])])
    directions = np.linspace(-math.pi, math.pi, mrpt.BEAMS)
    assert sorted(ranges[ranges > 0.0]) == [1.0, 4.0]
    assert directions[np.argmax(ranges)] == pytest.approx(-math.pi / 2.0, abs=0.01)
