"""A Command of the Operator's application as plain data, and the checks that reject it."""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from dataclasses import dataclass
from typing import Callable, Optional, Sequence

from mtr_core.problems import NO_PROBLEM, Problem, Sentence
from mtr_core.requests import Press, Waypoint
from mtr_core.states import Direction

from . import problems
from .area.order import AreaOrder, order_problem

# A test area is some ten metres across; a waypoint beyond this distance is a mistake of units or sign.
MAX_COORDINATE_M = 100.0
# Two turns: an unwrapped heading may exceed one turn; a larger value is a mistake of units.
MAX_HEADING_RAD = 4.0 * math.pi
# Highest key of any supported mast; the peripherals know the actual range.
MAX_KEY_HEIGHT_M = 3.0
MAX_PRESS_DURATION_S = 10.0
MAX_BUTTONS = 8
# A remote key has about ten buttons; a larger number is not a button.
MAX_BUTTON = 100
# A refusal quotes at most this many of the numbers.
MAX_QUOTED = 10


@dataclass(frozen=True)
class Command:
    """The desired final state of the robot. None leaves the choice to the robot."""

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
    resume_hold_id: int = 0
    watches: bool = False
    area: Optional[AreaOrder] = None
    enter_service: bool = False
    leave_service_id: int = 0


def problem_of(command: Command, platform_speed_mps: float) -> Problem:
    """Return why the Command is refused; no problem if it is acceptable."""
    return (_waypoint_problem(command.waypoint)
            or _choice_problem(problems.MAXIMUM_SPEED, command.max_speed_mps, 0.01, platform_speed_mps)
            or _choice_problem(problems.KEY_HEIGHT, command.key_height_m, 0.0, MAX_KEY_HEIGHT_M)
            or _press_problem(command.press)
            or order_problem(command.area))


def _waypoint_problem(waypoint: Optional[Waypoint]) -> Problem:
    if waypoint is None:
        return NO_PROBLEM
    if waypoint.id == 0:
        return problems.WAYPOINT_WITHOUT_ID()
    if waypoint.direction not in tuple(Direction):
        return problems.WAYPOINT_DIRECTION(id=waypoint.id, value=waypoint.direction)
    pose = waypoint.pose
    x, y, heading = (functools.partial(sentence, id=waypoint.id) for sentence in (
        problems.WAYPOINT_X, problems.WAYPOINT_Y, problems.WAYPOINT_HEADING))
    return (_range_problem(x, pose.x, -MAX_COORDINATE_M, MAX_COORDINATE_M)
            or _range_problem(y, pose.y, -MAX_COORDINATE_M, MAX_COORDINATE_M)
            or _range_problem(heading, pose.heading, -MAX_HEADING_RAD, MAX_HEADING_RAD))


def _press_problem(press: Optional[Press]) -> Problem:
    if press is None:
        return NO_PROBLEM
    if press.id == 0:
        return problems.PRESS_WITHOUT_ID()
    if not _are_buttons(press.buttons):
        return problems.PRESS_BUTTONS(id=press.id, buttons=_quoted(press.buttons), maximum=MAX_BUTTONS,
                                      highest=MAX_BUTTON)
    strength, duration = (functools.partial(sentence, id=press.id) for sentence in (
        problems.PRESS_STRENGTH, problems.PRESS_DURATION))
    return (_range_problem(strength, press.strength, 0.0, 1.0)
            or _range_problem(duration, press.duration_s, 0.0, MAX_PRESS_DURATION_S))


def _are_buttons(numbers: Sequence[int]) -> bool:
    return (1 <= len(numbers) <= MAX_BUTTONS and len(set(numbers)) == len(numbers)
            and all(1 <= number <= MAX_BUTTON for number in numbers))


def _quoted(numbers: Sequence[int]) -> str:
    more = f" and {len(numbers) - MAX_QUOTED} more" if len(numbers) > MAX_QUOTED else ""
    return f"{list(numbers[:MAX_QUOTED])}{more}"


def _choice_problem(sentence: Sentence, value: Optional[float], low: float, high: float) -> Problem:
    return NO_PROBLEM if value is None else _range_problem(sentence, value, low, high)


def _range_problem(sentence: Callable[..., Problem], value: float, low: float, high: float) -> Problem:
    """Return the problem of a value outside its range, which includes NaN."""
    return NO_PROBLEM if low <= value <= high else sentence(value=value, low=low, high=high)
