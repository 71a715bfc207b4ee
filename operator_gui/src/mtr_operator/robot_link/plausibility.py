"""Plausibility check of the numbers in a Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Iterator

from mtr_operator.domain import limits
from mtr_operator.domain.limits import Limit, first_violation
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus

# Older robots send it as NaN while it is unknown.
_MAY_BE_NAN = "device_height"


def plausible(status: RobotStatus) -> RobotStatus:
    """Return the Status; an invalid pose with implausible numbers is removed."""
    if status.pose_valid or not first_violation(_pose(status)):
        return status
    nan = math.nan
    return replace(status, x=nan, y=nan, heading=nan, position_sigma_m=nan, heading_sigma_rad=nan, variance_x_m2=nan,
                   variance_y_m2=nan, covariance_xy_m2=nan)


def violation_of(status: RobotStatus) -> str:
    """Return a sentence about the first implausible number; empty without one."""
    if status.pose_valid and not all(map(math.isfinite, (status.x, status.y, status.heading))):
        return "The pose is valid and lacks a coordinate."
    return first_violation(_numbers(status))


def not_finite(message: Any) -> str:
    """Return a sentence about the first number of a valid pose that is not finite; empty without one.

    In the domain's types NaN represents a number that was not sent.
    """
    if not message.state.pose_valid:
        return ""
    return next((f"{field.name} of a valid pose is {value}." for field, value in message.state.ListFields()
                 if isinstance(value, float) and field.name != _MAY_BE_NAN and not math.isfinite(value)), "")


def _numbers(status: RobotStatus) -> Iterator[tuple[Limit, object]]:
    yield limits.STAMP, status.sent_s
    yield limits.STAMP, status.stamp_s
    yield from _known(limits.STAMP, status.steady_s)
    yield from _pose(status)
    yield limits.SPEED, status.speed_mps
    yield limits.YAW_RATE, status.yaw_rate_radps
    yield from ((limits.KEY_OFFSET, value) for value in (status.key_x, status.key_y))
    yield from _known(limits.KEY_HEIGHT, status.key_height_m)
    if status.battery_percent is not None:
        yield limits.BATTERY, status.battery_percent
    if status.car is not None:
        yield from _car(status.car)
    frame = status.car_frame
    yield limits.CORRECTION, frame.correction_x
    yield limits.CORRECTION, frame.correction_y
    yield limits.HEADING, frame.correction_heading
    yield from _reports(status)


def _pose(status: RobotStatus) -> Iterator[tuple[Limit, object]]:
    """Yield the numbers that are not NaN: older robots do not send all of them."""
    for limit, value in ((limits.COORDINATE, status.x), (limits.COORDINATE, status.y), (limits.HEADING, status.heading),
                         (limits.POSITION_SIGMA, status.position_sigma_m),
                         (limits.HEADING_SIGMA, status.heading_sigma_rad), (limits.VARIANCE, status.variance_x_m2),
                         (limits.VARIANCE, status.variance_y_m2), (limits.COVARIANCE, status.covariance_xy_m2)):
        yield from _known(limit, value)


def _car(car: CarDimensions) -> Iterator[tuple[Limit, object]]:
    yield limits.CAR_LENGTH, car.length
    yield limits.CAR_WIDTH, car.width
    yield limits.CAR_SIGMA, car.length_sigma
    yield limits.CAR_SIGMA, car.width_sigma
    for sigma_m in car.side_sigmas:
        yield from _known(limits.CAR_SIGMA, sigma_m)
    yield Limit("number of points of the Car's outline", 0, limits.MAX_OUTLINE_POINTS), len(car.outline)
    for point in car.outline[:limits.MAX_OUTLINE_POINTS]:
        yield from ((limits.OUTLINE, coordinate) for coordinate in point)


def _reports(status: RobotStatus) -> Iterator[tuple[Limit, object]]:
    for press in status.presses:
        yield limits.STAMP, press.start_s
        yield limits.STAMP, press.end_s
    check = status.car_check
    if check is not None:
        for value in (check.difference_m, check.difference_rad, check.limit_m, check.limit_rad):
            yield from _known(limits.CHECK_DIFFERENCE, value)


def _known(limit: Limit, value: float) -> Iterator[tuple[Limit, object]]:
    if not math.isnan(value):
        yield limit, value
