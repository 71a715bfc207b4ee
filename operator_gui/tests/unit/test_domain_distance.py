"""Distance at an instant: interpolation and uncertainty."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.distance import distance_to_outline, measure, measure_at
from mtr_operator.domain.actions.pose_history import PoseHistory, PoseSample, PoseUnknown
from mtr_operator.domain.geometry.outline import NO_ERROR, OriginError, origin_error, side_errors
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus

CAR = CarDimensions(4.5, 1.8, 0.04, 0.02)
LEFT = Ray(0.0, 0.9, 0.0, 1.0)


def status(stamp_s, y=3.0, heading=-math.pi / 2, valid=True):
    return RobotStatus(id=1, robot_session_id=1, stamp_s=stamp_s, x=0.0, y=y, heading=heading, pose_valid=valid,
                       position_sigma_m=0.03, heading_sigma_rad=0.02, key_x=0.25)


def history(*statuses):
    poses = PoseHistory()
    for item in statuses:
        poses.add(item)
    return poses


def test_pose_between_two_statuses_is_interpolated():
    poses = history(status(1.0, 3.0), status(1.1, 2.9), status(1.2, 2.7))
    assert poses.at(1.175).pose.y == pytest.approx(2.75)
    assert poses.at(1.1).pose.y == 2.9


def test_heading_is_interpolated_across_pi():
    poses = history(status(1.0, heading=3.1), status(1.1, heading=-3.1))
    assert abs(poses.at(1.05).pose.heading) == pytest.approx(math.pi)


@pytest.mark.parametrize("time_s", [0.9, 1.21])
def test_pose_outside_the_history_is_unknown(time_s):
    with pytest.raises(PoseUnknown):
        history(status(1.0), status(1.2)).at(time_s)


def test_pose_within_a_gap_is_unknown():
    with pytest.raises(PoseUnknown, match=r"0\.7 s"):
        history(status(1.0), status(1.3, valid=False), status(1.7)).at(1.2)


def test_invalid_and_repeated_poses_are_not_remembered():
    poses = history(status(1.0, 3.0), status(1.0, 9.0), status(1.1, 9.0, valid=False), status(1.2, 2.8))
    assert poses.at(1.1).pose.y == pytest.approx(2.9)


def test_distance_is_that_of_the_key_from_the_side():
    distance = measure(LEFT, history(status(1.0, 3.0), status(1.1, 2.9)).at(1.05), 0.0)
    assert distance.distance_m == pytest.approx(2.95 - 0.25 - 0.9)
    assert distance.robot_time_s == 1.05


def test_uncertainty_is_the_root_of_the_sum_of_squares():
    sample = PoseSample(1.0, Pose(0.0, 3.0, 0.0), 0.4, 0.03, 0.02, 0.25, 0.0)
    expected = math.sqrt(0.03 ** 2 + (0.02 * 0.25) ** 2 + (0.4 * 0.1) ** 2 + 0.01 ** 2)
    assert measure(LEFT, sample, 0.1, OriginError(0.01 ** 2, 0.0)).uncertainty_m == pytest.approx(expected)


def test_time_counts_by_the_speed_or_by_where_the_key_was_about_the_instant():
    sample, near = (PoseSample(1.0, Pose(0.0, y, -math.pi / 2), 0.4, 0.0, 0.0, 0.25, 0.0) for y in (3.0, 3.1))
    moved = measure(LEFT, sample, 0.1, NO_ERROR, [near, sample])
    assert moved.uncertainty_m == pytest.approx(math.sqrt(0.1 ** 2 / 2.0))
    assert measure(LEFT, sample, 0.1, NO_ERROR, [sample]).uncertainty_m == pytest.approx(0.04)


SPEED_MPS, BRAKES_MPS2, STOPS_S, STOPS_M = 0.4, 0.5, 10.0, 0.5


def stopping(time_s):
    """Distance of the key, and speed, of an approach that ends."""
    left_s = max(STOPS_S - time_s, 0.0)
    braking_s = min(left_s, SPEED_MPS / BRAKES_MPS2)
    return (STOPS_M + BRAKES_MPS2 * braking_s ** 2 / 2.0 + SPEED_MPS * (left_s - braking_s),
            min(BRAKES_MPS2 * left_s, SPEED_MPS))


def stopping_poses(until_s=13.0):
    """A Status each 0.1 s."""
    told = ((8.0 + 0.1 * index, *stopping(8.0 + 0.1 * index)) for index in range(round((until_s - 8.0) * 10.0) + 1))
    return history(*(replace(status(stamp_s, 0.9 + 0.25 + distance_m), speed_mps=speed_mps, position_sigma_m=0.004)
                     for stamp_s, distance_m, speed_mps in told))


@pytest.mark.parametrize("cycle_s", [0.1, 0.4, 0.77])
def test_change_within_a_cycle_in_which_the_robot_came_to_a_stand_is_within_3_sigma(cycle_s):
    poses, ratios = stopping_poses(), []
    for changed_s in (STOPS_S - 0.35, *(9.0 + 0.05 * index for index in range(40))):
        for phase in range(8):
            frame_s = changed_s + phase / 8.0 * cycle_s
            measured = measure_at(LEFT, poses, frame_s - cycle_s / 2.0, math.hypot(cycle_s / math.sqrt(12.0), 0.004))
            ratios.append(abs(stopping(changed_s)[0] - measured.distance_m) / measured.uncertainty_m)
    assert max(ratios) <= 3.0


def test_time_counts_as_before_where_the_speed_is_the_same_all_the_while():
    measured = measure_at(LEFT, stopping_poses(), 8.5, 0.1)
    assert measured.uncertainty_m == pytest.approx(math.hypot(0.004, 0.1 * SPEED_MPS))


@pytest.mark.parametrize("time_s", [8.0, 8.5])
def test_instants_without_a_pose_say_nothing_of_where_the_key_was(time_s):
    measured = measure_at(LEFT, stopping_poses(8.5), time_s, 0.1)
    assert measured.uncertainty_m == pytest.approx(math.hypot(0.004, 0.1 * SPEED_MPS))


def test_heading_does_not_count_when_the_key_lies_on_the_ray():
    sample = PoseSample(1.0, Pose(0.0, 3.0, -math.pi / 2), 0.0, 0.03, 0.02, 0.25, 0.0)
    assert measure(LEFT, sample, 0.1).uncertainty_m == pytest.approx(0.03)


def test_uncertainty_is_not_a_number_when_the_robot_does_not_say():
    sample = PoseSample(1.0, Pose(0.0, 3.0, 0.0), 0.0, math.nan, 0.0, 0.25, 0.0)
    assert math.isnan(measure(LEFT, sample, 0.0).uncertainty_m)


HALF = math.sqrt(0.5)
FRONT, REAR, CORNER = Ray(2.25, 0.0, 1.0, 0.0), Ray(-2.25, 0.0, -1.0, 0.0), Ray(-2.25, 0.9, -HALF, HALF)
# Front and rear of one sigma each, errors independent: the centre's variance is 0.25 (0.11^2 + 0.03^2).
ENDS = replace(CAR, length_sigma=math.hypot(0.11, 0.03), front_sigma=0.11, rear_sigma=0.03, left_sigma=0.0125,
               right_sigma=0.0125, width_sigma=0.024)
CENTRE_SIGMA_M = 0.5 * math.hypot(0.11, 0.03)


def test_outline_without_its_sides_adds_half_the_dimension_along_the_axis():
    assert origin_error(LEFT, CAR) == pytest.approx((0.01 ** 2, 0.0))
    assert origin_error(FRONT, CAR) == pytest.approx((0.02 ** 2, 0.0))
    assert origin_error(CORNER, CAR) == pytest.approx((0.5 * (0.01 ** 2 + 0.02 ** 2), 0.0))
    assert origin_error(Ray(0.0, 0.0, 1.0, 0.0), CAR) == origin_error(Ray(0.0, 0.0, 1.0, 0.0), ENDS) == NO_ERROR
    assert side_errors(FRONT, CAR) == ()


@pytest.mark.parametrize(("ray", "sigma_m"), [(FRONT, 0.11), (REAR, 0.03), (LEFT, 0.0125),
                                              (CORNER, math.hypot(0.03, 0.0125) * HALF)])
def test_uncertainty_of_a_distance_holds_that_of_the_side_where_its_line_begins(ray, sigma_m):
    """Status has the variance of base_link, the Car's centre included; the side takes the centre's place."""
    own_m, across_m = 0.004, math.sqrt(0.0125 ** 2 - 0.012 ** 2)
    sample = PoseSample(1.0, Pose(ray.origin_x + 3.0 * ray.direction_x, ray.origin_y + 3.0 * ray.direction_y, 0.0), 0.0,
                        math.nan, 0.0, 0.0, 0.0,
                        covariance=(own_m ** 2 + CENTRE_SIGMA_M ** 2, own_m ** 2 + across_m ** 2, 0.0))
    measured = measure(ray, sample, 0.0, origin_error(ray, ENDS))
    assert measured.uncertainty_m == pytest.approx(math.hypot(own_m, sigma_m))
    assert math.hypot(*(side.along_m for side in side_errors(ray, ENDS))) == pytest.approx(sigma_m)


def test_distance_is_never_surer_than_the_side_where_its_line_begins():
    sample = PoseSample(1.0, Pose(-5.25, 0.0, 0.0), 0.0, 0.001, 0.0, 0.0, 0.0)
    assert measure(REAR, sample, 0.0, origin_error(REAR, ENDS)).uncertainty_m == pytest.approx(0.03)


def test_gap_to_the_outline():
    assert distance_to_outline(Ray(0.0, 0.0, 1.0, 0.0), 3.0, CAR) == pytest.approx(0.75)
    assert distance_to_outline(Ray(0.0, 0.0, 0.0, 1.0), 0.5, CAR) == 0.0


def test_uncertainty_takes_the_position_along_the_ray_when_the_robot_says_it():
    sample = PoseSample(1.0, Pose(0.0, 3.0, -math.pi / 2), 0.0, 0.2, 0.0, 0.25, 0.0, (0.04, 0.0009, 0.0))
    assert measure(LEFT, sample, 0.0).uncertainty_m == pytest.approx(0.03)


def test_uncertainty_on_an_oblique_ray_counts_the_covariance():
    ray = Ray(0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
    sample = PoseSample(1.0, Pose(2.0, 2.0, -3 * math.pi / 4), 0.0, 0.2, 0.0, 0.25, 0.0, (0.01, 0.01, -0.009))
    assert measure(ray, sample, 0.0).uncertainty_m == pytest.approx(math.sqrt(0.001))


@pytest.mark.parametrize("name", ["x", "y", "heading", "stamp_s", "speed_mps", "key_x"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_n3_pose_that_is_not_finite_is_not_remembered(name, value):
    poses = history(status(1.0), replace(status(1.1), **{name: value}), status(1.2))
    assert [sample.stamp_s for sample in poses.samples] == [1.0, 1.2]


@pytest.mark.parametrize("time_s", [math.nan, math.inf, -math.inf])
def test_pose_at_an_instant_that_is_not_known_is_unknown(time_s):
    with pytest.raises(PoseUnknown, match="not known"):
        history(status(1.0), status(1.2)).at(time_s)


def timed(steady_s, step_s, pose_age_s=0.1):
    """Status of a robot whose clock is ahead of its steady clock; its pose is some time old."""
    was_set = steady_s >= 2.0
    seen_before = steady_s - pose_age_s < 2.0
    stamp_s = steady_s - pose_age_s + (0.0 if seen_before or not was_set else step_s)
    return replace(status(stamp_s, 3.0 - 0.5 * (steady_s - pose_age_s)), steady_s=steady_s,
                   sent_s=steady_s + (step_s if was_set else 0.0))


@pytest.mark.parametrize("step_s", [0.02, 0.05, 0.4, 3600.0, -0.02, -0.09, -0.4, -3600.0])
def test_b4_no_pose_lies_between_poses_of_before_and_after_the_clock_was_set(step_s):
    poses = history(*(timed(1.0 + 0.1 * index, step_s) for index in range(40)))
    assert poses.samples[0].stamp_s - step_s > 2.0
    assert all(sample.pose.y == pytest.approx(3.0 - 0.5 * (sample.stamp_s - step_s)) for sample in poses.samples)


def test_clock_that_is_not_set_forgets_no_pose():
    poses = history(*(timed(1.0 + 0.1 * index, 0.004) for index in range(40)))
    assert len(poses.samples) == 40
