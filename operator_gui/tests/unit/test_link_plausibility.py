"""Numbers of a Status that cannot be true: nothing is computed with them. C5, N2, N3"""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain import limits
from mtr_operator.domain.limits import Limit, first_violation
from mtr_operator.domain.ports import LinkStatistics
from mtr_operator.robot_link.conversions import ImplausibleMessage, decode_status
from mtr_operator.robot_link.inbox import Inbox
from mtr_proto import robot_link_pb2 as pb

SPOILED = [
    ("state.x", 1e30, "position is 1e+30 m; allowed is -1000 to 1000 m."), ("state.x", math.nan, "lacks a coordinate"),
    ("state.y", -math.inf, "lacks"), ("state.y", -1e4, "position"), ("state.heading", 1e9, "heading"),
    ("state.position_sigma_m", -5.0, "uncertainty of the position is -5 m"),
    ("state.position_sigma_m", 0.0, "uncertainty of the position is 0 m"),
    ("state.position_sigma_m", math.nan, "position_sigma_m of a valid pose is nan"),
    ("state.position_sigma_m", math.inf, "uncertainty"), ("state.heading_sigma_rad", -0.1, "heading"),
    ("state.variance_x_m2", math.inf, "variance"), ("state.covariance_xy_m2", math.nan, "covariance_xy_m2"),
    ("state.speed", math.nan, "speed"), ("state.speed", 1e6, "speed"), ("state.yaw_rate_radps", math.inf, "turning"),
    ("state.key_x", math.nan, "place of the Remote key"), ("state.device_height", 1e9, "height"),
    ("state.device_height", math.inf, "height"), ("state.stamp_s", 1e13, "time is"),
    ("state.battery_level", 2 ** 31 - 1, "charge"),
    ("car.length", 1e9, "length of the Car is 1e+09 m; allowed is 1 to 30 m."), ("car.length", -4.5, "length"),
    ("car.length", 0.0, "length"), ("car.length", math.nan, "length"), ("car.width", 1e6, "width"),
    ("car.width", math.inf, "width"), ("car.length_sigma", -1.0, "uncertainty of the Car's size"),
    ("car.correction_x", math.nan, "correction"), ("car.outline_x", [1e9, 0.0, 0.0], "outline"),
    ("car.outline_y", [math.nan, 0.0, 0.0], "outline"), ("sent_time_s", math.nan, "time"),
    ("sent_time_s", -1.0, "time"), ("sent_time_s", 1e13, "time"), ("steady_time_s", math.inf, "time"),
    ("presses", [pb.PressConfirmation(id=1, start_s=math.nan, end_s=1.0)], "time"),
    ("car_check.difference_m", -1.0, "difference"),
]


def good():
    message = pb.Status(id=5, robot_session_id=2, sent_time_s=100.0, steady_time_s=10.0)
    state = message.state
    state.x, state.y, state.heading, state.stamp_s, state.pose_valid = 1.0, 2.0, 0.5, 99.9, True
    state.position_sigma_m, state.heading_sigma_rad, state.speed = 0.02, 0.01, 0.5
    car = message.car
    car.length, car.width, car.length_sigma, car.width_sigma, car.mapped = 4.5, 1.8, 0.01, 0.01, True
    car.outline_x.extend([2.2, -2.2, 0.0])
    car.outline_y.extend([0.9, 0.9, -0.9])
    return message


def spoil(message, path, value):
    *parents, name = path.split(".")
    for parent in parents:
        message = getattr(message, parent)
    if isinstance(value, list):
        del getattr(message, name)[:]
        getattr(message, name).extend(value)
    else:
        setattr(message, name, value)


def test_good_numbers_pass():
    assert decode_status(good().SerializeToString()).car.length == 4.5


@pytest.mark.parametrize("path, value, words", SPOILED, ids=[f"{path}={value}" for path, value, _ in SPOILED])
def test_status_with_an_impossible_number_is_counted_told_and_not_used(path, value, words):
    message = good()
    spoil(message, path, value)
    with pytest.raises(ImplausibleMessage):
        decode_status(message.SerializeToString())
    statistics = LinkStatistics()
    inbox = Inbox(statistics)
    inbox.put([message.SerializeToString()])
    assert inbox.take() is None
    assert (statistics.implausible, statistics.ignored, statistics.received) == (1, 1, 0)
    assert "Status 5" in statistics.last_error and words in statistics.last_error


@pytest.mark.parametrize("size", [(1.0, 0.5), (30.0, 5.0)])
def test_ends_of_the_cars_range_are_allowed(size):
    message = good()
    message.car.length, message.car.width = size
    assert decode_status(message.SerializeToString()).car.length == size[0]


def test_pose_that_the_robot_calls_invalid_may_be_anything_and_is_nothing():
    message = good()
    message.state.pose_valid, message.state.x, message.state.position_sigma_m = False, 1e30, math.inf
    status = decode_status(message.SerializeToString())
    assert math.isnan(status.x) and math.isnan(status.position_sigma_m) and not status.pose_valid


def test_size_of_a_car_that_is_not_mapped_is_not_looked_at():
    message = good()
    message.car.mapped, message.car.length = False, math.nan
    assert decode_status(message.SerializeToString()).car is None


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 10 ** 400, "4.5", None, True, [4.5], -1.0, 31])
def test_what_is_no_number_in_range_is_a_sentence(value):
    assert not limits.CAR_LENGTH.allows(value)
    assert limits.CAR_LENGTH.violation(value, "Car of the file: ").startswith("Car of the file: length of the Car is ")


def test_first_violation_is_told():
    speed = Limit("speed", 0.0, 1.0, "m/s")
    assert first_violation([(speed, 0.5), (speed, 2.0), (speed, 3.0)]) == "speed is 2 m/s; allowed is 0 to 1 m/s."
    assert first_violation([(speed, 1.0)]) == ""
