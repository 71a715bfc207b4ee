"""From a robot that has just been switched on to one that can measure: key at its height, Car mapped."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from ..errors import RobotFailed
from ..geometry.ray import Ray
from ..robot_status import CarCheck, Mode, RobotStatus
from ..supervision.area import await_area
from ..supervision.refusals import refuse_contradicted_sheet, refuse_unready
from .car import Car
from .control_loop import ControlLoop
from .robot import Robot

# Robot times after which waiting is in vain.
START_LIMIT_S = 60.0
MAPPING_LIMIT_S = 600.0
# A robot gives a silent application up after 3 s, and lets the next one take over.
CONTROL_LIMIT_S = 10.0
# The first waypoint makes the robot map the Car; before that nobody knows how long the Car is, so it lies well ahead.
_AHEAD_OF_CAR = Ray(0.0, 0.0, 1.0, 0.0)
_AHEAD_M = 5.0


def prepare(loop: ControlLoop, robot: Robot, car: Car, key_height_m: float, maximum_speed_mps: float) -> None:
    """Wait until robot and Car are ready; an OperatorError says what is missing."""
    robot.say("wait for robot and Car")
    _wait_until(loop, START_LIMIT_S, "did not start", _has_started)
    car.prepare()
    _wait_for_control(loop)
    refuse_unready(loop)
    await_area(loop)
    robot.say(f"move the key to {100.0 * key_height_m:g} cm")
    robot.set_maximum_speed(maximum_speed_mps)
    robot.move_key_to(key_height_m)
    if not _is_ready(loop.status):
        robot.say("map the Car")
        robot.go_to(_AHEAD_OF_CAR, _AHEAD_M)
        _wait_until(loop, MAPPING_LIMIT_S, "did not find the Car", _is_ready)
    refuse_contradicted_sheet(loop.status)


def check_car(robot: Robot) -> CarCheck | None:
    """Have the robot look whether the Car still stands where it was measured; None when it cannot check."""
    if not robot.can_check_car:
        robot.say("warning: the robot's software is too old to check where the Car stands; it is taken as it is")
        return None
    robot.say("check where the Car stands")
    return robot.check_car()


def prepare_to_check(loop: ControlLoop, robot: Robot) -> None:
    """Wait until the robot can look at the Car; RobotFailed when it has not found it or cannot check."""
    robot.say("wait for the robot")
    _wait_until(loop, START_LIMIT_S, "did not start", _has_started)
    _wait_for_control(loop)
    if loop.status.car is None:
        raise RobotFailed("The robot has not found the Car yet, so there is nothing to check; a test begins with it.")
    if not robot.can_check_car:
        raise RobotFailed("The robot's software is too old to check where the Car stands.")


def _has_started(status: RobotStatus) -> bool:
    return status.mode not in (Mode.UNKNOWN, Mode.STARTING)


def _is_ready(status: RobotStatus) -> bool:
    return status.mode is Mode.FOLLOWING_WAYPOINT and status.car is not None and status.pose_valid


def _wait_for_control(loop: ControlLoop) -> None:
    until_s = loop.waited_s + CONTROL_LIMIT_S
    while loop.status.controlled_by_other:
        if loop.waited_s >= until_s:
            raise RobotFailed("The robot is controlled by another application; end that one, then start again.")
        loop.step()


def _wait_until(loop: ControlLoop, limit_s: float, failure: str, condition: Callable[[RobotStatus], bool]) -> None:
    until_s = loop.waited_s + limit_s
    while not condition(loop.status):
        if loop.waited_s >= until_s:
            texts = [notification.text for notification in loop.status.notifications]
            raise RobotFailed(" ".join([f"The robot {failure} within {limit_s:g} s.", *texts]))
        loop.step()
