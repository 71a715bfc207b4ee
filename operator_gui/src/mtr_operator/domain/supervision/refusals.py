"""Conditions for the start of a test on the connected robot; RobotFailed states the first missing one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..actions.control_loop import ControlLoop
from ..battery.levels import is_critical
from ..errors import CarActive, RobotFailed
from ..interfaces.car_bus import BusMonitor
from ..interfaces.part import part
from ..robot_status import DISK_FULL_CODE, NO_STOP_CODE, SHEET_CONTRADICTED_CODE, RobotStatus
from .preflight_rule import preflight_hindrance

# A battery reports once a second.
CHARGE_LIMIT_S = 5.0
# A robot reports its preflight once a second; an earlier version never does.
PREFLIGHT_LIMIT_S = 3.0


def refuse_unready(loop: ControlLoop) -> None:
    """Raise RobotFailed unless preflight, Car, disk, battery and hand-held stop permit a test."""
    _require_preflight(loop)
    _refuse_active_car(loop)
    _refuse_notified(loop.status, DISK_FULL_CODE)
    _require_charge(loop)
    _require_hand_held_stop(loop.status)


def refuse_contradicted_sheet(status: RobotStatus) -> None:
    """Raise RobotFailed if the scans contradict the data sheet of the Car; known after mapping."""
    _refuse_notified(status, SHEET_CONTRADICTED_CODE)


def _require_preflight(loop: ControlLoop) -> None:
    until_s = loop.waited_s + PREFLIGHT_LIMIT_S
    while loop.preflight is None and loop.waited_s < until_s:
        loop.step()
    hindrance = preflight_hindrance(loop.preflight, loop.status)
    if hindrance:
        raise RobotFailed(hindrance)


def _refuse_active_car(loop: ControlLoop) -> None:
    active = loop.car_guard.begin(part(loop.car_link, BusMonitor).signals)
    if active:
        raise CarActive(f"The test does not begin. {active}")


def _refuse_notified(status: RobotStatus, code: str) -> None:
    for notification in status.notifications:
        if notification.code == code:
            raise RobotFailed(notification.text)


def _require_charge(loop: ControlLoop) -> None:
    until_s = loop.waited_s + CHARGE_LIMIT_S
    while loop.status.battery_percent is None and loop.waited_s < until_s:
        loop.step()
    percent = loop.status.battery_percent
    if percent is None:
        raise RobotFailed("The robot does not report the charge of its battery; check the topic of its battery, then "
                          "begin the test.")
    if is_critical(percent):
        raise RobotFailed(f"The robot's battery is nearly empty ({percent} %); charge it, then begin the test.")


def _require_hand_held_stop(status: RobotStatus) -> None:
    if any(notification.code == NO_STOP_CODE for notification in status.notifications):
        raise RobotFailed("The robot has no hand-held emergency stop, so no test begins. Start it with its controller "
                          "(controller:=true).")
