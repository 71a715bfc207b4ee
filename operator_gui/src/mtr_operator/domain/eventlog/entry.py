"""Entry of the event list."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import enum
from dataclasses import dataclass

# Severities, with the robot's numbers.
INFO, WARNING, ERROR = 1, 2, 3
SEVERITY_WORDS = {INFO: "info", WARNING: "warning", ERROR: "error"}
# Sources other than nodes of the robot.
ROBOT, CAR, APPLICATION = "robot", "Car", "application"


class EventKind(enum.Enum):
    """Subject of an entry; the value is used in files."""

    ROBOT_LOG = "robot log"
    FAULT = "fault"
    ANSWER = "answer"
    LOCKS = "locks"
    TEST = "test"
    OPERATOR = "operator"


@dataclass(frozen=True)
class EventEntry:
    """One event.

    Attributes:
        time: of the report, by this computer's clock. robot_time_s: of the event, by the robot's clock, None if
        unknown.
            severity: INFO, WARNING or ERROR. source: reporter, a node of the robot for its log.
        text: one sentence.
    """

    time: datetime.datetime
    robot_time_s: float | None
    kind: EventKind
    severity: int
    source: str
    text: str
