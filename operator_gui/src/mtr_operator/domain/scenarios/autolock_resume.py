"""Whether an axis on which the Car has unlocked can be finished after an interruption, with the retreat alone.

It can while nothing has changed: the same Car frame, the Car still unlocked, the robot on the axis, where it stopped. A
Car that has locked in the meantime has to be approached again, a robot that was driven away has left the place, and
where a timer locks the Car nobody saw when it began.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..actions.car import Car
from ..actions.distance import Distance
from ..actions.robot import Robot
from ..geometry.ray import Ray
from ..ports import LockState
from ..requests import Direction
from .autolock_parameters import AutolockParameters
from .autolock_result import LOCK, UNLOCK, pass_word

# A robot that loses its application goes on for up to 1 s, and brakes.
_BEYOND_M = 1.0


def can_go_on(axis: Ray, parameters: AutolockParameters, robot: Robot, car: Car) -> bool:
    """True when the points that are kept make a pass complete, or the retreat from here does."""
    if robot.kept(UNLOCK) is None or robot.trouble():
        return False
    number = 1
    while robot.kept(pass_word(LOCK, number)) is not None:
        number += 1
    # Between two passes: one more begins as a pass does, from wherever the robot is.
    if robot.kept(pass_word(UNLOCK, number)) is None:
        return True
    here = robot.key_distance(axis, robot.now_s, 0.0)
    return (not car.relocks and car.lock_state is LockState.UNLOCKED and is_on_axis(axis, parameters, robot)
            and parameters.minimum_distance_m - _BEYOND_M <= here.distance_m <= parameters.straightened_distance_m)


def is_on_axis(axis: Ray, parameters: AutolockParameters, robot: Robot) -> bool:
    """True when the Remote key is near enough to the axis to be carried along it, and the robot looks along it."""
    here = robot.key_distance(axis, robot.now_s, 0.0)
    return (abs(here.lateral_m) <= parameters.lateral_tolerance_m
            and abs(here.heading_rad) <= parameters.heading_tolerance_rad)


def come_back(axis: Ray, unlocked: Distance, robot: Robot) -> None:
    """Bring the Remote key where the Car has unlocked, if it is farther away: there the Car knows it."""
    if robot.key_distance(axis, robot.now_s, 0.0).distance_m > unlocked.distance_m:
        robot.go_to(axis, unlocked.distance_m, Direction.FORWARD)
        robot.wait_until_reached()
