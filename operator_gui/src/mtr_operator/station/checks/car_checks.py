"""Checks of the Car's bus before the robot moves."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator

from mtr_operator.domain.absent_car import NO_ADAPTER
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.supervision.car_signals import (
    DOOR,
    GEAR,
    IGNITION,
    SPEED,
    CarSignals,
    SignalState,
    first_active,
)

from ..events import RobotSnapshot
from .finding import Check, Finding, Item, State

# CiA's recommendation for a bus with timely messages.
FULL_BUS = 0.7
# A mean cycle of the lock message longer than the profile's by this ratio indicates a different car.
SLOW_CYCLE = 1.5
# Keys fall asleep after a rest of a minute or more (mtr_simulation, honest_handle.yaml).
AWAKE_S = 60.0


def key(answered_s: float | None) -> Item:
    """Check the key, whose sleep is visible only in the Car's reaction."""
    if answered_s is not None and answered_s < AWAKE_S:
        return Item(Check.KEY, State.GOOD, Finding.KEY_ANSWERED, numbers=(answered_s,))
    return Item(Check.KEY, State.UNKNOWN, Finding.KEY_UNKNOWN)


def bus(robot: RobotSnapshot) -> Iterator[Item]:
    """Check adapter and traffic, the locks, and the time of frames on the robot's clock."""
    traffic = robot.traffic
    if robot.car_problem == NO_ADAPTER:
        yield Item(Check.BUS, State.BAD, Finding.NO_ADAPTER)
        yield Item(Check.LOCKS, State.UNKNOWN, Finding.LOCKS_UNKNOWN)
        yield Item(Check.CLOCK, State.UNKNOWN, Finding.CLOCK_UNKNOWN)
        return
    clock = "" if traffic is None else traffic.clock_problem
    if clock:
        yield Item(Check.CLOCK, State.BAD if robot.car_problem else State.NOTE, Finding.CLOCK_NOT_MAPPED, clock)
    else:
        yield Item(Check.CLOCK, State.GOOD, Finding.CLOCK_MAPPED)
    yield _traffic(robot, clock)
    is_heard = robot.lock_state is not LockState.UNKNOWN
    yield (Item(Check.LOCKS, State.GOOD, Finding.LOCKS_HEARD, robot.lock_state.value) if is_heard
           else Item(Check.LOCKS, State.UNKNOWN if robot.car_problem else State.BAD, Finding.LOCKS_UNKNOWN))


def stop_signals(signals: CarSignals) -> Item:
    """Check the reception of the signals that stop the robot, and list those that the profile lacks."""
    active = first_active(signals)
    if active is not None:
        return Item(Check.SIGNALS, State.BAD, Finding.SIGNAL_ACTIVE, active.sentence)
    silent = [each.source for each in signals if each.state is SignalState.UNKNOWN]
    if silent:
        return Item(Check.SIGNALS, State.UNKNOWN, Finding.SIGNALS_SILENT, ", ".join(silent))
    unnamed = [kind for kind in (IGNITION, GEAR, SPEED, DOOR) if kind not in {each.kind for each in signals}]
    if unnamed:
        return Item(Check.SIGNALS, State.UNKNOWN, Finding.SIGNALS_UNNAMED, ", ".join(unnamed))
    return Item(Check.SIGNALS, State.GOOD, Finding.SIGNALS_FINE)


def _traffic(robot: RobotSnapshot, clock_problem: str) -> Item:
    traffic = robot.traffic
    if robot.car_problem and robot.car_problem != clock_problem:
        return Item(Check.BUS, State.BAD, Finding.BUS_TROUBLED, robot.car_problem)
    if traffic is None:
        return Item(Check.BUS, State.GOOD, Finding.BUS_SIMULATED)
    if traffic.load > FULL_BUS:
        return Item(Check.BUS, State.NOTE, Finding.BUS_FULL, numbers=(100.0 * traffic.load,))
    cycle_s = traffic.cycle_s if traffic.cycle_s is not None else math.nan
    if cycle_s > SLOW_CYCLE * traffic.expected_cycle_s:
        return Item(Check.BUS, State.NOTE, Finding.BUS_SLOW, numbers=(cycle_s, traffic.expected_cycle_s))
    return Item(Check.BUS, State.GOOD, Finding.BUS_FINE, numbers=(100.0 * traffic.load, cycle_s))
