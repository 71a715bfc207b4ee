"""Rigid motions of the plane."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mtr_core.se2 import Pose2, wrap_angle

coordinates = st.floats(-100.0, 100.0)
angles = st.floats(-20.0, 20.0)
poses = st.builds(Pose2, coordinates, coordinates, angles)


def assert_same(first, second):
    assert first.x == pytest.approx(second.x, abs=1e-9)
    assert first.y == pytest.approx(second.y, abs=1e-9)
    assert wrap_angle(first.heading - second.heading) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("angle", "wrapped"), [
    (0.0, 0.0), (math.pi, math.pi), (-math.pi, math.pi), (3.0 * math.pi, math.pi), (1.5 * math.pi, -0.5 * math.pi)])
def test_angle_is_wrapped_into_half_open_turn(angle, wrapped):
    assert wrap_angle(angle) == pytest.approx(wrapped)


@given(angles)
def test_wrapped_angle_points_the_same_way(angle):
    wrapped = wrap_angle(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-9)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-9)


def test_point_ahead_of_a_robot_that_faces_left_lies_to_the_left():
    assert Pose2(1.0, 2.0, math.pi / 2.0).apply(3.0, 0.0) == pytest.approx((1.0, 5.0))


def test_composition_applies_the_right_transform_first():
    map_from_base = Pose2(1.0, 0.0, math.pi / 2.0)
    base_from_key = Pose2(0.25, 0.0, 0.0)
    assert_same(map_from_base @ base_from_key, Pose2(1.0, 0.25, math.pi / 2.0))


@given(poses)
def test_transform_after_its_inverse_is_identity(pose):
    assert_same(pose @ pose.inverse(), Pose2(0.0, 0.0, 0.0))
    assert_same(pose.inverse() @ pose, Pose2(0.0, 0.0, 0.0))


@given(poses, poses, poses)
def test_composition_is_associative(a, b, c):
    assert_same((a @ b) @ c, a @ (b @ c))


def test_distance_ignores_the_heading():
    assert Pose2(0.0, 0.0, 1.0).distance_to(Pose2(3.0, 4.0, -1.0)) == pytest.approx(5.0)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf])
def test_pose_with_a_component_that_is_not_finite_is_recognised(wrong):
    assert Pose2(0.0, 0.0, 0.0).is_finite()
    assert not Pose2(wrong, 0.0, 0.0).is_finite()
    assert not Pose2(0.0, wrong, 0.0).is_finite()
    assert not Pose2(0.0, 0.0, wrong).is_finite()
