"""Checklist before the robot moves: one finding per item, from the current data; no Qt."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Iterator

from mtr_operator.domain.supervision.car_signals import DOOR, first_active
from mtr_operator.domain.supervision.conditions import CONDITIONS

from ..estimate import Plan
from ..events import RobotSnapshot
from ..readiness import SILENCE_LIMIT_S
from ..sight.ways import Ways, spans
from . import area_check, car_checks, robot_checks
from .finding import Check, Finding, Item, State
from .preflight_check import preflight

# A long test with its pictures needs some 20 MB, and its journal is written before the robot continues.
LEAST_FREE_BYTES, FEW_FREE_BYTES = 50_000_000, 500_000_000
_BYTES_PER_MB = 1e6
# Checks without a sensor of the robot, which a person must do before it drives around the Car.
UNSEEN = {Check.STOP_TRIAL: Finding.STOP_UNTRIED, Check.GROUND: Finding.GROUND_UNSEEN,
          Check.CABLES: Finding.CABLES_UNSEEN, Check.OPENINGS: Finding.OPENINGS_UNSEEN,
          Check.FITTINGS: Finding.FITTINGS_UNSEEN,
          Check.AREA: Finding.AREA_UNSEEN, Check.PEOPLE: Finding.PEOPLE_UNSEEN, Check.WEATHER: Finding.WEATHER_UNSEEN,
          Check.LIGHT: Finding.LIGHT_UNSEEN, Check.CAR: Finding.CAR_UNSEEN,
          Check.ATTENDANCE: Finding.ATTENDANCE_UNSEEN}
# Checks that request an operating condition, see domain.supervision.conditions.
CONDITION_OF = {Check[name.upper()]: name for name in CONDITIONS}


@dataclass(frozen=True)
class Wanted:
    """Test that is about to start. plan: None before one is selected. limits: number of loaded ones, 0 for none;
    limits_problem: reason why they do not match. ways: free lines, None before the Car is mapped. confirmed: operating
    conditions that a person has confirmed."""

    plan: Plan | None = None
    limits: int = 0
    limits_problem: str = ""
    ways: Ways | None = None
    confirmed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Facts:
    """Data available before the robot moves.

    silent_s: wall time since the newest Status. answered_s: wall time since the Car's locks moved, None if that was not
    observed. free_bytes: on the disk of the results, None if unknown.
    """

    robot: RobotSnapshot | None
    silent_s: float
    wanted: Wanted = Wanted()
    answered_s: float | None = None
    free_bytes: int | None = None


def checklist(facts: Facts) -> tuple[Item, ...]:
    """Return all items in their order."""
    robot = facts.robot
    items = list(_of_robot(robot, facts) if robot is not None and facts.silent_s < SILENCE_LIMIT_S
                 else _of_silence(facts.silent_s))
    items += [_unseen(check, finding, facts) for check, finding in UNSEEN.items()]
    items += [_disk(facts.free_bytes), _limits(facts.wanted)]
    order = list(Check)
    return tuple(sorted(items, key=lambda item: order.index(item.check)))


def hindrances(items: tuple[Item, ...]) -> tuple[Item, ...]:
    """Return the items that prevent the start of a test."""
    return tuple(item for item in items if item.state is State.BAD)


def _unseen(check: Check, finding: Finding, facts: Facts) -> Item:
    if CONDITION_OF.get(check) in facts.wanted.confirmed:
        return Item(check, State.GOOD, Finding.CONFIRMED)
    opened = None if check is not Check.OPENINGS or facts.robot is None else first_active(facts.robot.signals, (DOOR,))
    return Item(check, State.UNKNOWN, finding) if opened is None else \
        Item(check, State.NOTE, Finding.OPENINGS_OPEN, opened.sentence)


def _of_silence(silent_s: float) -> Iterator[Item]:
    yield Item(Check.LINK, State.BAD, Finding.LINK_SILENT, numbers=(silent_s,))
    for check in Check:
        if check not in (Check.LINK, Check.DISK, Check.LIMITS, *UNSEEN):
            yield Item(check, State.UNKNOWN, Finding.UNHEARD)


def _of_robot(robot: RobotSnapshot, facts: Facts) -> Iterator[Item]:
    status = robot.status
    yield Item(Check.LINK, State.GOOD, Finding.LINK_ALIVE, numbers=(facts.silent_s,))
    yield _encryption(robot)
    yield from robot_checks.condition(status)
    yield preflight(robot)
    yield robot_checks.emergency_stop(status)
    yield robot_checks.position(status)
    yield area_check.test_area(status.area)
    yield robot_checks.size(status.car, facts.wanted.plan)
    yield _way(facts.wanted.ways)
    yield from robot_checks.parts(status)
    yield robot_checks.battery(status.battery_percent, facts.wanted.plan)
    yield from car_checks.bus(robot)
    yield car_checks.stop_signals(robot.signals)
    yield robot_checks.clock(robot.clock_ahead_s)
    yield car_checks.key(facts.answered_s)


def _encryption(robot: RobotSnapshot) -> Item:
    if robot.is_secret:
        return Item(Check.ENCRYPTION, State.GOOD, Finding.ENCRYPTED)
    if robot.is_exposed:
        return Item(Check.ENCRYPTION, State.NOTE, Finding.NOT_ENCRYPTED)
    return Item(Check.ENCRYPTION, State.GOOD, Finding.LOCAL_LINK)


def _way(ways: Ways | None) -> Item:
    """Check the lines; obstacles do not prevent a start, because they may leave, and the robot avoids or refuses
    them."""
    if ways is None:
        return Item(Check.WAY, State.UNKNOWN, Finding.WAY_TO_COME)
    if ways.hindered:
        return Item(Check.WAY, State.NOTE, Finding.WAY_HINDERED, spans(ways.hindered), (ways.gap_m,))
    if ways.unseen:
        return Item(Check.WAY, State.UNKNOWN, Finding.WAY_UNSEEN, spans(ways.unseen))
    return Item(Check.WAY, State.GOOD, Finding.WAY_FREE)


def _disk(free_bytes: int | None) -> Item:
    if free_bytes is None:
        return Item(Check.DISK, State.UNKNOWN, Finding.DISK_UNKNOWN)
    numbers = (free_bytes / _BYTES_PER_MB,)
    if free_bytes < LEAST_FREE_BYTES:
        return Item(Check.DISK, State.BAD, Finding.DISK_FULL, numbers=numbers)
    is_short = free_bytes < FEW_FREE_BYTES
    return Item(Check.DISK, State.NOTE if is_short else State.GOOD,
                Finding.DISK_SHORT if is_short else Finding.DISK_FINE, numbers=numbers)


def _limits(wanted: Wanted) -> Item:
    if wanted.limits_problem:
        return Item(Check.LIMITS, State.BAD, Finding.LIMITS_UNFIT, wanted.limits_problem)
    if wanted.limits:
        return Item(Check.LIMITS, State.GOOD, Finding.LIMITS_LOADED, numbers=(wanted.limits,))
    return Item(Check.LIMITS, State.NOTE, Finding.NO_LIMITS)
