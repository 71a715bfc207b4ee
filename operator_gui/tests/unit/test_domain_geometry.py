"""Axes, radials and waypoints on them."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.geometry.axes import axes_around
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.robot_status import CarDimensions

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)


def test_axes_of_all_sides_and_corners():
    sides = [axis.side for axis in axes_around(CAR, 1.0)]
    assert sides == ["front", "front_right", *5 * ["right"], "rear_right", "rear", "rear_left", *5 * ["left"],
                     "front_left"]


def test_axes_that_exceed_the_car_are_left_out():
    offsets = [axis.ray.origin_x for axis in axes_around(CAR, 0.75) if axis.side == "left"]
    assert offsets == [-2.25, -1.5, -0.75, 0.0, 0.75, 1.5, 2.25]
    offsets = [axis.ray.origin_x for axis in axes_around(CAR, 0.76) if axis.side == "left"]
    assert offsets == pytest.approx([-1.52, -0.76, 0.0, 0.76, 1.52])


def test_spacing_wider_than_the_car_leaves_the_centres():
    assert len(axes_around(CAR, 10.0)) == 8


def test_axes_go_once_around_the_car_clockwise():
    bearings = [math.atan2(axis.ray.point(4.0)[1], axis.ray.point(4.0)[0]) for axis in axes_around(CAR, 0.4)]
    turns = [math.remainder(after - before, 2 * math.pi) for before, after in zip(bearings, bearings[1:])]
    assert all(turn < 0 for turn in turns)
    assert -2 * math.pi < sum(turns)


def test_axes_leave_the_car_orthogonally_or_diagonally():
    directions = {axis.side: (axis.ray.direction_x, axis.ray.direction_y) for axis in axes_around(CAR, 1.0)}
    half = math.sqrt(0.5)
    assert directions == {"front": (1, 0), "rear": (-1, 0), "left": (0, 1), "right": (0, -1),
                          "front_left": (half, half), "front_right": (half, -half), "rear_left": (-half, half),
                          "rear_right": (-half, -half)}


@pytest.mark.parametrize(("spacing_deg", "count"), [(45, 8), (30, 12), (360, 1), (359, 2), (100, 4), (7, 52)])
def test_radials_are_all_below_a_full_circle(spacing_deg, count):
    assert len(radials_around(math.radians(spacing_deg))) == count


def test_radials_turn_clockwise_from_the_front():
    points = [radial.ray.point(1.0) for radial in radials_around(math.radians(90))]
    for point, expected in zip(points, [(1, 0), (0, -1), (-1, 0), (0, 1)]):
        assert point == pytest.approx(expected)


def test_waypoint_brings_the_key_to_the_distance_facing_the_car():
    ray = Ray(2.25, 0.9, math.sqrt(0.5), math.sqrt(0.5))
    base = ray.base_pose(2.0, (0.25, 0.03))
    assert base.heading == pytest.approx(math.radians(-135))
    assert base.apply((0.25, 0.03)) == pytest.approx(ray.point(2.0))
    assert ray.distance_of(base.apply((0.25, 0.03))) == pytest.approx(2.0)


def test_distance_is_the_component_along_the_ray():
    assert Ray(0.0, 0.9, 0.0, 1.0).distance_of((0.3, 2.0)) == pytest.approx(1.1)


def test_pose_turns_counterclockwise():
    assert Pose(1.0, 2.0, math.pi / 2).apply((1.0, 0.0)) == pytest.approx((1.0, 3.0))
