"""One entry of the event list."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import enum
from dataclasses import dataclass

# Severities, as the robot counts them.
INFO, WARNING, ERROR = 1, 2, 3
SEVERITY_WORDS = {INFO: "info", WARNING: "warning", ERROR: "error"}
# Sources that are no node of the robot.
ROBOT, CAR, APPLICATION = "robot", "Car", "application"


class EventKind(enum.Enum):
    """What an entry is about; the word stands in files."""

    ROBOT_LOG = "robot log"
    FAULT = "fault"
    ANSWER = "answer"
    LOCKS = "locks"
    TEST = "test"
    OPERATOR = "operator"


@dataclass(frozen=True)
class EventEntry:
    """Something that has happened.

    Attributes:
        time: by this computer's clock, when it was told. robot_time_s: when it happened by the robot's clock, None when
            that is not known. severity: INFO, WARNING or ERROR. source: who says it, a node of the robot for its log.
        text: one sentence.
    """

    time: datetime.datetime
    robot_time_s: float | None
    kind: EventKind
    severity: int
    source: str
    text: str
