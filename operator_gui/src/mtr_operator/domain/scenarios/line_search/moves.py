"""How the key is moved along a line between two attempts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ...actions.robot import Robot
from ...geometry.ray import Ray
from ...requests import Direction
from .trial import SearchParameters

# The robot stops within some millimetres; a shorter way would be a manoeuvre and no move.
_MIN_WAY_M = 0.05


def drive(ray: Ray, from_m: float, to_m: float, robot: Robot) -> None:
    """Facing the Car: forwards to it, backwards from it."""
    if abs(to_m - from_m) >= _MIN_WAY_M:
        robot.go_to(ray, to_m, Direction.FORWARD if to_m < from_m else Direction.BACKWARD)
        robot.wait_until_reached()


def wake_key(ray: Ray, place_m: float, parameters: SearchParameters, robot: Robot) -> None:
    """Half a wavelength to the side and back, to where it stands."""
    plan = parameters.search_plan
    robot.say("move the key so that it does not sleep")
    move_key(ray, place_m, (1.0 if place_m < plan.maximum_m else -1.0) * plan.half_wavelength_m, robot)
    robot.wait(parameters.settle_time_s)


def move_key(ray: Ray, place_m: float, by_m: float, robot: Robot) -> None:
    """Along the line by a distance, away from the Car if it is positive, and back to where it stands."""
    drive(ray, place_m, place_m + by_m, robot)
    drive(ray, place_m + by_m, place_m, robot)
