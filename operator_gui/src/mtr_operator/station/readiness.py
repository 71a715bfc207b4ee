"""Readiness for a test in one word, with each reason against a start."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from mtr_operator.domain.absent_car import NO_ADAPTER
from mtr_operator.domain.battery.levels import is_critical, is_low
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import (
    DISK_FULL_CODE,
    LINK_LOST_CODE,
    Mode,
    RobotStatus,
    WaypointResult,
)
from mtr_operator.domain.supervision.car_signals import first_active
from mtr_operator.domain.supervision.preflight_rule import preflight_hindrance

from .events import RobotSnapshot
from .motion import Motion, is_driving

# Wall time without a Status after which the link counts as lost.
SILENCE_LIMIT_S = 1.5
WARNING, ERROR = 2, 3


class ReadinessWord(enum.Enum):
    """Readiness in one word."""

    READY = "ready"
    WARNINGS = "ready with warnings"
    NOT_READY = "not ready"
    MEASURING = "measuring"
    PAUSED = "paused"
    LOST = "communication lost"
    DRIVING = "driving"
    MAPPING = "mapping"
    CHECKING = "checking"
    BLOCKED = "blocked"


class Phase(enum.Enum):
    """Activity of the application."""

    IDLE = "idle"
    MEASURING = "measuring"
    STOPPING = "stopping"
    PAUSED = "paused"
    FINISHED = "finished"


# Phases of a running test.
RUNNING = (Phase.MEASURING, Phase.STOPPING)


class Cause(enum.Enum):
    """Kinds of reasons; a view has a sentence and a remedy for each."""

    ROBOT_SILENT = "robot silent"
    ROBOT_STARTING = "robot starting"
    ROBOT_FAULT = "robot fault"
    OTHER_OPERATOR = "controlled by another application"
    NOTIFICATION = "notification"
    BATTERY_EMPTY = "battery empty"
    BATTERY_LOW = "battery low"
    BATTERY_UNKNOWN = "battery unknown"
    NO_CAN = "no CAN adapter"
    CAN_PROBLEM = "CAN problem"
    LOCKS_UNKNOWN = "locks unknown"
    POSITION_LOST = "position lost"
    HELD = "held"
    WAY_BLOCKED = "way blocked"
    PREFLIGHT_BAD = "preflight bad"
    PREFLIGHT_MISSING = "preflight missing"
    CAR_ACTIVE = "Car active"


HELD_CODE = "held"
# Code of the robot's sentence on a hold after a stop by the Operator.
STOPPED_CODE = "state_machine.held_stop"
# Errors that do not prevent a start: a robot on hold is resumed during the test.
NOT_BLOCKING = ("unencrypted", HELD_CODE)
# Errors that do not stop a run: the lines of the test are written on the laptop.
NOT_BLOCKING_A_RUN = (DISK_FULL_CODE,)
# In these modes the robot itself reports the cause.
MODE_CODES = ("fault", LINK_LOST_CODE, "not_localized")


@dataclass(frozen=True)
class Reason:
    """Reason against a start, or a warning. detail: sentence of robot or link, or a number; may be empty."""

    cause: Cause
    is_blocking: bool
    detail: str = ""


@dataclass(frozen=True)
class Readiness:
    """Readiness word and its reasons, blocking ones first."""

    word: ReadinessWord
    reasons: tuple[Reason, ...] = ()

    @property
    def can_start(self) -> bool:
        """True if a test may be started."""
        return self.word in (ReadinessWord.READY, ReadinessWord.WARNINGS)


def readiness_of(robot: RobotSnapshot | None, silent_s: float, phase: Phase, motion: Motion | None = None) -> Readiness:
    """Return the readiness from the robot's latest data, silent_s of wall time ago. motion: None has no orders.

    Obstacles to the robot's current action have the highest priority, then the action, then the readiness for a test.
    """
    if robot is None or silent_s >= SILENCE_LIMIT_S:
        return Readiness(ReadinessWord.LOST, (Reason(Cause.ROBOT_SILENT, True, f"{silent_s:.0f}"),))
    found = [*_robot_reasons(robot.status, phase), *_car_reasons(robot), *_preflight_reasons(robot, phase)]
    reasons = sorted(found, key=lambda reason: not reason.is_blocking)
    word = _word_of_motion(robot.status, phase, motion)
    if word is not None:
        hindrances = _hindrances(robot.status)
        told = {reason.detail for reason in hindrances}
        reasons = [*hindrances, *(reason for reason in reasons if reason.detail not in told)]
        is_blocked = hindrances or (phase in RUNNING and any(reason.is_blocking for reason in reasons))
        return Readiness(ReadinessWord.BLOCKED if is_blocked else word, tuple(reasons))
    if phase is Phase.PAUSED:
        return Readiness(ReadinessWord.PAUSED, tuple(reasons))
    if any(reason.is_blocking for reason in reasons):
        return Readiness(ReadinessWord.NOT_READY, tuple(reasons))
    return Readiness(ReadinessWord.WARNINGS if reasons else ReadinessWord.READY, tuple(reasons))


def _word_of_motion(status: RobotStatus, phase: Phase, motion: Motion | None) -> ReadinessWord | None:
    for mode, word in ((Mode.MAPPING_CAR, ReadinessWord.MAPPING), (Mode.CHECKING_CAR, ReadinessWord.CHECKING)):
        if status.mode is mode and (motion is None or phase in RUNNING or motion.goes_round(mode)):
            return word
    if phase in RUNNING:
        return ReadinessWord.MEASURING
    return ReadinessWord.DRIVING if is_driving(status) else None


def _hindrances(status: RobotStatus) -> list[Reason]:
    """Return the reasons why the robot cannot continue to its destination."""
    if status.hold_id:
        held = next((each.text for each in status.notifications if each.code == HELD_CODE), "")
        return [Reason(Cause.HELD, True, held)]
    if status.waypoint_result is WaypointResult.BLOCKED:
        return [Reason(Cause.WAY_BLOCKED, True, status.waypoint_message)]
    return []


def is_held_by_stop(status: RobotStatus) -> bool:
    """Return True for a robot on hold only because of a stop by the Operator."""
    return bool(status.hold_id) and any(each.code == HELD_CODE and problem.code == STOPPED_CODE
                                        for each in status.notifications for problem in each.problems[:1])


def can_resume(readiness: Readiness) -> bool:
    """Return True if a paused test can be resumed."""
    return readiness.word is ReadinessWord.PAUSED and not any(reason.is_blocking for reason in readiness.reasons)


def _robot_reasons(status: RobotStatus, phase: Phase) -> list[Reason]:
    reasons = []
    notified = {notification.code: notification for notification in status.notifications}
    if status.controlled_by_other:
        reasons.append(Reason(Cause.OTHER_OPERATOR, True))
    if status.mode in (Mode.UNKNOWN, Mode.STARTING):
        reasons.append(Reason(Cause.ROBOT_STARTING, True))
    if status.mode is Mode.FAULT:
        reasons.append(Reason(Cause.ROBOT_FAULT, True, notified["fault"].text if "fault" in notified else ""))
    # A robot that has not mapped the Car yet cannot know its position.
    if status.mode is Mode.FOLLOWING_WAYPOINT and not status.pose_valid:
        lost = notified.get("not_localized")
        reasons.append(Reason(Cause.POSITION_LOST, True, lost.text if lost else ""))
    reasons += _battery_reasons(status.battery_percent, phase)
    harmless = (*NOT_BLOCKING, *(NOT_BLOCKING_A_RUN if phase in RUNNING else ()))
    reasons += [Reason(Cause.NOTIFICATION, notification.severity >= ERROR and code not in harmless, notification.text)
                for code, notification in notified.items()
                if notification.severity >= WARNING and code not in (*MODE_CODES, "low_battery")]
    return reasons


def _battery_reasons(percent: int | None, phase: Phase) -> list[Reason]:
    """Return the reasons of the battery. An unknown charge prevents a start; a running test continues with a warning,
    because a person attends it."""
    if percent is None:
        return [Reason(Cause.BATTERY_UNKNOWN, phase not in RUNNING)]
    if is_critical(percent):
        return [Reason(Cause.BATTERY_EMPTY, True, str(percent))]
    return [Reason(Cause.BATTERY_LOW, False, str(percent))] if is_low(percent) else []


def _preflight_reasons(robot: RobotSnapshot, phase: Phase) -> list[Reason]:
    """Return the reasons of the preflight; a running test continues, because a person watches the robot."""
    report = robot.preflight
    if phase in RUNNING:
        return []
    if report is not None and report.hinders(robot.status.steady_s):
        return [Reason(Cause.PREFLIGHT_BAD, True, report.first_bad)]
    missing = preflight_hindrance(report, robot.status)
    return [Reason(Cause.PREFLIGHT_MISSING, True, missing)] if missing else []


def _car_reasons(robot: RobotSnapshot) -> list[Reason]:
    active = first_active(robot.signals)
    if active is not None:
        return [Reason(Cause.CAR_ACTIVE, True, active.sentence)]
    if robot.car_problem == NO_ADAPTER:
        return [Reason(Cause.NO_CAN, True)]
    if robot.car_problem:
        return [Reason(Cause.CAN_PROBLEM, True, robot.car_problem)]
    return [Reason(Cause.LOCKS_UNKNOWN, True)] if robot.lock_state is LockState.UNKNOWN else []
