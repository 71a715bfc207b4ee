"""Uncertainty in the messages of localization and Car locator, as the planner uses it."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_motion_planner.conversions import car_from, robot_from
from mtr_motion_planner.inputs import SideSigmas
from mtr_msgs.msg import CarEstimate, LocalizedPose


def car(**changed):
    message = CarEstimate(state=CarEstimate.LOCATED, outline_x=[1.0, -1.0, 0.0], outline_y=[0.0, 0.0, 1.0],
                          front_sigma=0.1, rear_sigma=0.2, left_sigma=0.03, right_sigma=0.04, length=4.5, width=1.8,
                          **changed)
    return car_from(message, 1.0)


def covariance(xx=0.0, xy=0.0, yy=0.0, heading=0.0):
    return [xx, xy, 0.0, xy, yy, 0.0, 0.0, 0.0, heading]


def test_each_side_of_the_car_has_its_own_sigma():
    found = car(covariance=covariance(0.01, 0.0, 0.01, 0.0004))
    assert found.sides == SideSigmas(0.1, 0.2, 0.03, 0.04)
    assert found.heading_sigma == pytest.approx(0.02) and found.size == (4.5, 1.8)
    assert found.is_finite()


@pytest.mark.parametrize("matrix, sigma_m", [
    (covariance(0.04, 0.0, 0.0001), 0.2), (covariance(0.0001, 0.0, 0.04), 0.2),
    (covariance(0.0101, 0.0099, 0.0101), math.sqrt(0.02)), (covariance(), 0.0)])
def test_own_position_counts_in_its_least_certain_direction(matrix, sigma_m):
    robot = robot_from(LocalizedPose(valid=True, covariance=[*matrix[:8], 0.0009]), 1.0)
    assert robot.position_sigma_m == pytest.approx(sigma_m)
    assert robot.heading_sigma == pytest.approx(0.03)


@pytest.mark.parametrize("index", [0, 1, 4, 8])
def test_covariance_that_is_no_number_is_none_for_the_robot(index):
    values = covariance(0.01, 0.0, 0.01, 0.01)
    values[index] = math.nan
    assert not robot_from(LocalizedPose(valid=True, covariance=values), 1.0).is_finite()


@pytest.mark.parametrize("value", [math.nan, -1.0])
def test_heading_variance_of_the_car_that_is_none_is_no_number(value):
    assert not car(covariance=covariance(heading=value)).is_finite()


def test_negative_sigma_of_a_side_is_not_used():
    message = CarEstimate(state=CarEstimate.LOCATED, front_sigma=-0.1)
    assert not car_from(message, 1.0).is_finite()


def test_car_without_a_size_has_its_outline_alone():
    message = CarEstimate(state=CarEstimate.COLLECTING, front_sigma=math.nan)
    assert car_from(message, 1.0).size == (math.inf, math.inf)
    assert car_from(message, 1.0).is_finite()
