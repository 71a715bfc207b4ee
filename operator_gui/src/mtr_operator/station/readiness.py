"""One word on whether a test can be started now, and each reason why not."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from mtr_operator.domain.absent_car import NO_ADAPTER
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import Mode, RobotStatus

from .events import RobotSnapshot

# Wall time without a Status after which the link counts as lost.
SILENCE_LIMIT_S = 1.5
# Below the first a test is not started, below the second it is warned of.
EMPTY_BATTERY_PERCENT = 10
LOW_BATTERY_PERCENT = 25
WARNING, ERROR = 2, 3


class ReadinessWord(enum.Enum):
    """Readiness in one word."""

    READY = "ready"
    WARNINGS = "ready with warnings"
    NOT_READY = "not ready"
    MEASURING = "measuring"
    PAUSED = "paused"
    LOST = "communication lost"


class Phase(enum.Enum):
    """What the application does."""

    IDLE = "idle"
    MEASURING = "measuring"
    STOPPING = "stopping"
    PAUSED = "paused"
    FINISHED = "finished"


class Cause(enum.Enum):
    """Kinds of reasons; a view has a sentence and an advice for each."""

    ROBOT_SILENT = "robot silent"
    ROBOT_STARTING = "robot starting"
    ROBOT_FAULT = "robot fault"
    OTHER_OPERATOR = "controlled by another application"
    NOTIFICATION = "notification"
    BATTERY_EMPTY = "battery empty"
    BATTERY_LOW = "battery low"
    NO_CAN = "no CAN adapter"
    CAN_PROBLEM = "CAN problem"
    LOCKS_UNKNOWN = "locks unknown"
    POSITION_LOST = "position lost"


# In these the robot itself says what is the matter.
# Red, and no reason not to start: a robot may have no emergency stop, and one that is held is released during the test.
_NOT_BLOCKING = ("no_emergency_stop", "held")
_MODE_CODES = ("fault", "link_lost", "not_localized")


@dataclass(frozen=True)
class Reason:
    """Why not, or a warning. detail: what robot or link say themselves, or a number; may be empty."""

    cause: Cause
    is_blocking: bool
    detail: str = ""


@dataclass(frozen=True)
class Readiness:
    """The word and its reasons, blocking ones first."""

    word: ReadinessWord
    reasons: tuple[Reason, ...] = ()

    @property
    def can_start(self) -> bool:
        """True when a test may be started."""
        return self.word in (ReadinessWord.READY, ReadinessWord.WARNINGS)


def readiness_of(robot: RobotSnapshot | None, silent_s: float, phase: Phase) -> Readiness:
    """Readiness by what came from the robot last, silent_s of wall time ago."""
    if robot is None or silent_s >= SILENCE_LIMIT_S:
        return Readiness(ReadinessWord.LOST, (Reason(Cause.ROBOT_SILENT, True, f"{silent_s:.0f}"),))
    reasons = sorted([*_robot_reasons(robot.status), *_car_reasons(robot)], key=lambda reason: not reason.is_blocking)
    if phase in (Phase.MEASURING, Phase.STOPPING):
        return Readiness(ReadinessWord.MEASURING, tuple(reasons))
    if phase is Phase.PAUSED:
        return Readiness(ReadinessWord.PAUSED, tuple(reasons))
    if any(reason.is_blocking for reason in reasons):
        return Readiness(ReadinessWord.NOT_READY, tuple(reasons))
    return Readiness(ReadinessWord.WARNINGS if reasons else ReadinessWord.READY, tuple(reasons))


def can_resume(readiness: Readiness) -> bool:
    """True when nothing stands against going on with a paused test."""
    return readiness.word is ReadinessWord.PAUSED and not any(reason.is_blocking for reason in readiness.reasons)


def _robot_reasons(status: RobotStatus) -> list[Reason]:
    reasons = []
    notified = {notification.code: notification for notification in status.notifications}
    if status.controlled_by_other:
        reasons.append(Reason(Cause.OTHER_OPERATOR, True))
    if status.mode in (Mode.UNKNOWN, Mode.STARTING):
        reasons.append(Reason(Cause.ROBOT_STARTING, True))
    if status.mode is Mode.FAULT:
        reasons.append(Reason(Cause.ROBOT_FAULT, True, notified["fault"].text if "fault" in notified else ""))
    # A robot that has not mapped the Car yet cannot know where it is.
    if status.mode is Mode.FOLLOWING_WAYPOINT and not status.pose_valid:
        lost = notified.get("not_localized")
        reasons.append(Reason(Cause.POSITION_LOST, True, lost.text if lost else ""))
    if status.battery_percent is not None and status.battery_percent < LOW_BATTERY_PERCENT:
        is_empty = status.battery_percent < EMPTY_BATTERY_PERCENT
        reasons.append(Reason(Cause.BATTERY_EMPTY if is_empty else Cause.BATTERY_LOW, is_empty,
                              str(status.battery_percent)))
    reasons += [Reason(Cause.NOTIFICATION, notification.severity >= ERROR and code not in _NOT_BLOCKING,
                       notification.text)
                for code, notification in notified.items()
                if notification.severity >= WARNING and code not in (*_MODE_CODES, "low_battery")]
    return reasons


def _car_reasons(robot: RobotSnapshot) -> list[Reason]:
    if robot.car_problem == NO_ADAPTER:
        return [Reason(Cause.NO_CAN, True)]
    if robot.car_problem:
        return [Reason(Cause.CAN_PROBLEM, True, robot.car_problem)]
    return [Reason(Cause.LOCKS_UNKNOWN, True)] if robot.lock_state is LockState.UNKNOWN else []
