"""Differences between consecutive Statuses as sentences: confirmations and states of the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Callable, Iterator, NamedTuple

from ..robot_status import CarFrame, CheckState, EmergencyStop, Interventions, Mode, RobotStatus, WaypointResult
from .entry import ERROR, INFO, WARNING, EventKind

_MODES = {
    Mode.STARTING: "The robot starts.",
    Mode.READY_TO_MAP_CAR: "The robot is ready to map the Car.",
    Mode.MAPPING_CAR: "The robot maps the Car.",
    Mode.FOLLOWING_WAYPOINT: "The robot is ready to drive.",
    Mode.FAULT: "The robot has a fault.",
    Mode.CHECKING_CAR: "The robot checks where the Car stands.",
}
_INTERVENTIONS = {
    "manual_drives": "The robot was driven by hand.",
    "manual_lifts": "The lift was moved by hand.",
    "replans": "The path to the waypoint was planned anew.",
    "blockages": "The robot stopped because something stood in its way, or because it saw nothing.",
    "lock_stops": "A motion lock stopped the robot.",
    "firmware_resets": "The robot's peripherals started anew.",
    "clock_steps": "The robot's clock was set.",
}
# Events of normal operation.
_ORDINARY = ("replans",)
_STOPS = {
    EmergencyStop.ENGAGED: (ERROR, "The emergency stop is pressed."),
    EmergencyStop.RELEASED: (INFO, "The emergency stop is released."),
    EmergencyStop.ABSENT: (WARNING, "The robot has no emergency stop that its software sees."),
}
_CM_PER_M = 100.0


class Said(NamedTuple):
    """New sentence of the robot."""

    kind: EventKind
    severity: int
    text: str


def changes(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    """Yield all changes in a Status of the same start of the robot, in no particular order."""
    for look in _LOOKS:
        yield from look(before, now)


def _mode(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    if now.mode is not before.mode and now.mode in _MODES:
        is_fault = now.mode is Mode.FAULT
        yield Said(EventKind.FAULT if is_fault else EventKind.ANSWER, ERROR if is_fault else INFO, _MODES[now.mode])


def _waypoint(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    result = now.waypoint_result
    if (now.waypoint_id, result) == (before.waypoint_id, before.waypoint_result):
        return
    if result is WaypointResult.REACHED:
        yield Said(EventKind.ANSWER, INFO, f"Waypoint {now.waypoint_id} is reached.")
    elif result is WaypointResult.REFUSED:
        yield Said(EventKind.ANSWER, ERROR, now.waypoint_message or f"Waypoint {now.waypoint_id} is refused.")
    elif result is WaypointResult.BLOCKED:
        yield Said(EventKind.FAULT, WARNING, now.waypoint_message or "Something stands in the robot's way.")
    elif result is WaypointResult.PENDING and before.waypoint_result is WaypointResult.BLOCKED:
        yield Said(EventKind.FAULT, INFO, "The robot's way is free again.")


def _presses(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    known = {press.id for press in before.presses} if before.session_id == now.session_id else set()
    for press in now.presses:
        if press.id not in known:
            yield Said(EventKind.ANSWER, ERROR, press.error) if press.error else \
                Said(EventKind.ANSWER, INFO, f"The button was pressed for {press.end_s - press.start_s:.2f} s.")


def _check(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    check, former = now.car_check, before.car_check
    if check is None or (former is not None and (check.id, check.state) == (former.id, former.state)):
        return
    if check.state is CheckState.PASSED:
        yield Said(EventKind.ANSWER, INFO, check.message or "The Car stands where it was measured.")
    elif check.state is CheckState.FAILED:
        yield Said(EventKind.ANSWER, ERROR, check.message or "The Car does not stand where it was measured.")


def _frame(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    frame = now.car_frame
    if before.car is None and now.car is not None:
        yield Said(EventKind.ANSWER, INFO,
                   f"The Car is found: {now.car.length:.2f} m long, {now.car.width:.2f} m wide.")
    elif frame.revision != before.car_frame.revision:
        yield Said(EventKind.ANSWER, WARNING,
                   f"The Car coordinate system was corrected by {_CM_PER_M * _shift_m(frame):.1f} cm and "
                   f"{abs(math.degrees(frame.correction_heading)):.2f} degrees.")


def _shift_m(frame: CarFrame) -> float:
    return math.hypot(frame.correction_x, frame.correction_y)


def _interventions(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    if now.interventions == before.interventions:
        return
    for name, text in _INTERVENTIONS.items():
        if _count(now.interventions, name) > _count(before.interventions, name):
            yield Said(EventKind.FAULT, INFO if name in _ORDINARY else WARNING, text)


def _count(interventions: Interventions, name: str) -> int:
    return int(getattr(interventions, name))


def _emergency_stop(before: RobotStatus, now: RobotStatus) -> Iterator[Said]:
    if now.emergency_stop is not before.emergency_stop and now.emergency_stop in _STOPS:
        yield Said(EventKind.FAULT, *_STOPS[now.emergency_stop])


_Look = Callable[[RobotStatus, RobotStatus], Iterator[Said]]
_LOOKS: tuple[_Look, ...] = (_mode, _waypoint, _presses, _check, _frame, _interventions, _emergency_stop)
