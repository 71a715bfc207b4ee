"""A Command of the Operator's application as plain data, and what makes one unacceptable."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.errors import range_problem
from mtr_core.states import Direction

# A test area is some ten metres across; a waypoint farther away is a mistake of units or sign.
MAX_COORDINATE_M = 100.0
# Highest key of any supported mast; the peripherals know the real range.
MAX_KEY_HEIGHT_M = 3.0
MAX_PRESS_DURATION_S = 10.0
MAX_BUTTONS = 8


@dataclass(frozen=True)
class Waypoint:
    """A pose of base_link in the Car coordinate system, m and rad."""

    id: int
    x: float
    y: float
    heading: float
    direction: int = 0


@dataclass(frozen=True)
class Press:
    """One press of buttons; strength 0 to 1, duration in s (0: the key's default)."""

    id: int
    buttons: Tuple[int, ...]
    strength: float = 1.0
    duration_s: float = 0.0


@dataclass(frozen=True)
class Command:
    """The desired final state of the robot. None where the application leaves the choice to the robot."""

    session_id: int = 0
    id: int = 0
    seen_status_id: int = 0
    seen_robot_time_s: float = math.nan
    stop: bool = False
    waypoint: Optional[Waypoint] = None
    max_speed_mps: Optional[float] = None
    key_height_m: Optional[float] = None
    press: Optional[Press] = None
    map_car_id: int = 0
    end_session: bool = False
    check_car_id: int = 0


def problem_of(command: Command, platform_speed_mps: float) -> str:
    """Sentence that says why the Command is refused; empty when it is acceptable."""
    return (_waypoint_problem(command.waypoint)
            or _choice_problem("Maximum speed", command.max_speed_mps, 0.01, platform_speed_mps, "m/s")
            or _choice_problem("Key height", command.key_height_m, 0.0, MAX_KEY_HEIGHT_M, "m")
            or _press_problem(command.press))


def _waypoint_problem(waypoint: Optional[Waypoint]) -> str:
    if waypoint is None:
        return ""
    if waypoint.id == 0:
        return "Waypoint without an id; ids count from 1."
    if waypoint.direction not in tuple(Direction):
        return f"Waypoint {waypoint.id}: direction is {waypoint.direction}; allowed are 0, 1 and 2."
    name = f"Waypoint {waypoint.id}"
    return (range_problem(f"{name}: x", waypoint.x, -MAX_COORDINATE_M, MAX_COORDINATE_M, "m")
            or range_problem(f"{name}: y", waypoint.y, -MAX_COORDINATE_M, MAX_COORDINATE_M, "m")
            or range_problem(f"{name}: heading", waypoint.heading, -4.0 * math.pi, 4.0 * math.pi, "rad"))


def _press_problem(press: Optional[Press]) -> str:
    if press is None:
        return ""
    if press.id == 0:
        return "Button press without an id; ids count from 1."
    name = f"Button press {press.id}"
    if not 1 <= len(press.buttons) <= MAX_BUTTONS or 0 in press.buttons:
        return f"{name}: buttons are {list(press.buttons)}; allowed are 1 to {MAX_BUTTONS} numbers above 0."
    return (range_problem(f"{name}: strength", press.strength, 0.0, 1.0)
            or range_problem(f"{name}: duration", press.duration_s, 0.0, MAX_PRESS_DURATION_S, "s"))


def _choice_problem(name: str, value: Optional[float], low: float, high: float, unit: str) -> str:
    return "" if value is None else range_problem(name, value, low, high, unit)
