"""Checks of the robot's Status before it moves."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator

from mtr_operator.domain.actions.car_size import missing_measures, size_excess
from mtr_operator.domain.battery.levels import is_critical, is_low
from mtr_operator.domain.clocks.clock_offset import MAX_OFFSET_S, offset_sentence
from mtr_operator.domain.robot_status import (
    NO_STOP_CODE,
    SERVICE_CODE,
    CarDimensions,
    EmergencyStop,
    Mode,
    Notification,
    RobotStatus,
)

from ..estimate import Plan
from ..readiness import ERROR, MODE_CODES, NOT_BLOCKING, WARNING
from .finding import Check, Finding, Item, State

_BOARD_CODES = ("peripherals", "peripherals_silent")
# Part of the codes of the robot's sentences about LiDARs.
_LIDAR = "lidar"


def condition(status: RobotStatus) -> Iterator[Item]:
    """Check if the robot accepts orders, and list its sentences that belong to no other item."""
    said = {notification.code: notification.text for notification in status.notifications}
    troubles = []
    if status.controlled_by_other:
        troubles.append(Item(Check.ROBOT, State.BAD, Finding.OTHER_OPERATOR))
    if status.mode in (Mode.UNKNOWN, Mode.STARTING):
        troubles.append(Item(Check.ROBOT, State.BAD, Finding.ROBOT_STARTING))
    if status.mode is Mode.FAULT:
        troubles.append(Item(Check.ROBOT, State.BAD, Finding.ROBOT_FAULT, said.get("fault", "")))
    troubles += [Item(Check.ROBOT, _severity(each), Finding.IN_SERVICE if each.code == SERVICE_CODE else
                      Finding.ROBOT_SAYS, each.text) for each in _warnings(status)
                 if not _is_of_lidar(each) and each.code not in (*_BOARD_CODES, NO_STOP_CODE)]
    yield from troubles or [Item(Check.ROBOT, State.GOOD, Finding.ROBOT_READY)]


def _warnings(status: RobotStatus) -> list[Notification]:
    """Return the robot's sentences that other items do not show."""
    return [each for each in status.notifications
            if each.severity >= WARNING and each.code not in (*MODE_CODES, "low_battery")]


def _severity(notification: Notification) -> State:
    is_blocking = notification.severity >= ERROR and notification.code not in NOT_BLOCKING
    return State.BAD if is_blocking else State.NOTE


def emergency_stop(status: RobotStatus) -> Item:
    """Check the hand-held stop, which a test on a real robot requires; while it is engaged, the robot itself reports
    the effect."""
    stop = status.emergency_stop
    if any(each.code == NO_STOP_CODE for each in status.notifications):
        return Item(Check.EMERGENCY_STOP, State.BAD, Finding.STOP_MISSING)
    state, finding = {
        EmergencyStop.RELEASED: (State.GOOD, Finding.STOP_RELEASED),
        EmergencyStop.ENGAGED: (State.NOTE, Finding.STOP_ENGAGED),
        EmergencyStop.ABSENT: (State.NOTE, Finding.STOP_ABSENT),
        EmergencyStop.UNKNOWN: (State.UNKNOWN, Finding.STOP_UNKNOWN)}[stop]
    return Item(Check.EMERGENCY_STOP, state, finding)


def position(status: RobotStatus) -> Item:
    """Check the robot's position relative to the Car; before mapping the Car it is unknown."""
    if status.pose_valid:
        numbers = () if math.isnan(status.position_sigma_m) else (status.position_sigma_m,)
        return Item(Check.POSITION, State.GOOD, Finding.POSITION_KNOWN, numbers=numbers)
    if status.mode is not Mode.FOLLOWING_WAYPOINT:
        return Item(Check.POSITION, State.GOOD, Finding.POSITION_TO_COME)
    said = next((each.text for each in status.notifications if each.code == "not_localized"), "")
    return Item(Check.POSITION, State.BAD, Finding.POSITION_LOST, said)


def size(car: CarDimensions | None, plan: Plan | None = None) -> Item:
    """Check the Car's size: the smallest distance of the plan may require a data sheet."""
    if car is None:
        return Item(Check.SIZE, State.UNKNOWN, Finding.SIZE_TO_COME)
    nearness = plan.nearness if plan is not None else None
    if nearness is not None:
        return Item(Check.SIZE, State.BAD, Finding.SIZE_TOO_VAGUE, ", ".join(nearness.keys),
                    (nearness.vague_m, nearness.least_m))
    if car.knows_sides and size_excess(car):
        return Item(Check.SIZE, State.NOTE, Finding.SIZE_VAGUE, ", ".join(missing_measures(car)), (size_excess(car),))
    excess_m = size_excess(car)
    return (Item(Check.SIZE, State.NOTE, Finding.SIZE_OF_PLANE, numbers=(excess_m,)) if excess_m
            else Item(Check.SIZE, State.GOOD, Finding.SIZE_KNOWN))


def parts(status: RobotStatus) -> Iterator[Item]:
    """Check LiDARs, and the board of lift and buttons: the robot reports only their faults."""
    warnings = _warnings(status)
    of_lidars = [each for each in warnings if _is_of_lidar(each)]
    of_board = [each for each in warnings if each.code in _BOARD_CODES]
    for check, fine, said in ((Check.LIDARS, Finding.LIDARS_FINE, of_lidars),
                              (Check.BOARD, Finding.BOARD_FINE, of_board)):
        yield from ([Item(check, _severity(each), Finding.PART_TROUBLED, each.text) for each in said]
                    or [Item(check, State.GOOD, fine)])


def _is_of_lidar(notification: Notification) -> bool:
    return any(_LIDAR in problem.code for problem in notification.problems)


def clock(ahead_s: float) -> Item:
    """Report the offset of its clock from the laptop's, which prevents nothing; NaN: it has no time of day."""
    if math.isnan(ahead_s):
        return Item(Check.ROBOT_CLOCK, State.UNKNOWN, Finding.ROBOT_CLOCK_SIMULATED)
    said = offset_sentence(ahead_s)
    return (Item(Check.ROBOT_CLOCK, State.NOTE, Finding.ROBOT_CLOCK_APART, said) if said
            else Item(Check.ROBOT_CLOCK, State.GOOD, Finding.ROBOT_CLOCK_FINE, numbers=(MAX_OFFSET_S,)))


def battery(percent: int | None, plan: Plan | None) -> Item:
    """Check if the charge is sufficient for the plan, or at all."""
    if percent is None:
        return Item(Check.BATTERY, State.BAD, Finding.BATTERY_UNKNOWN)
    if is_critical(percent):
        return Item(Check.BATTERY, State.BAD, Finding.BATTERY_EMPTY, numbers=(percent,))
    if plan is not None and not plan.suffices(percent):
        return Item(Check.BATTERY, State.NOTE, Finding.BATTERY_SHORT, numbers=(percent, plan.battery_percent))
    if is_low(percent):
        return Item(Check.BATTERY, State.NOTE, Finding.BATTERY_LOW, numbers=(percent,))
    if plan is None:
        return Item(Check.BATTERY, State.GOOD, Finding.BATTERY_FINE, numbers=(percent,))
    return Item(Check.BATTERY, State.GOOD, Finding.BATTERY_SUFFICES, numbers=(percent, plan.battery_percent))
