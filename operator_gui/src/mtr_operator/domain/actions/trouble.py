"""What makes a measurement doubtful, and the two ways in which a scenario is left early."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..ports import CarLink, LockState
from ..robot_status import LINK_LOST_CODE, RobotStatus

# Robot time between two Status messages beyond which the link counts as interrupted. The robot stops by itself then.
LINK_GAP_S = 1.0
# A robot whose state is a fault, or unknown, stands, whether or not a motion lock had to stop it.
_FAULT_CODES = ("fault", "state_machine_silent")


class LineInvalid(Exception):
    """The line at hand cannot be measured now; the text says why. The test goes on with the next one.

    Attributes:
        evidence: what a person has to see of it, one text each: frames of the Car's bus.
        since_s: what was measured on this line at this robot time or later is void too.
    """

    def __init__(self, reason: str, evidence: tuple[str, ...] = (), since_s: float = math.inf):
        super().__init__(reason)
        self.evidence = evidence
        self.since_s = since_s


class LineLeft(LineInvalid):
    """The line at hand is left: a caller that would repeat what failed does not."""


class LineStopped(LineLeft):
    """A signal of the Car stops the robot on the line at hand, and the test with it; all of the line is void."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason, since_s=-math.inf)


class LineSkipped(LineLeft):
    """The Operator skips the line at hand."""

    def __init__(self) -> None:
        super().__init__("The line was skipped by the Operator.")


class Cancelled(Exception):
    """The Operator ends the test."""


def trouble_between(before: RobotStatus | None, status: RobotStatus, car_link: CarLink) -> str:
    """Sentence that says why a measurement between two Status messages would be doubtful; empty when it would not."""
    return (_link_trouble(before, status) or _pose_trouble(before, status) or _robot_trouble(status)
            or _car_trouble(car_link))


def _link_trouble(before: RobotStatus | None, status: RobotStatus) -> str:
    if before is not None and status.stamp_s - before.stamp_s > LINK_GAP_S:
        return f"The link to the robot was interrupted for {status.stamp_s - before.stamp_s:.1f} s."
    for notification in status.notifications:
        if notification.code == LINK_LOST_CODE:
            return f"The link to the robot was interrupted: {notification.text}"
    return ""


def _pose_trouble(before: RobotStatus | None, status: RobotStatus) -> str:
    if not status.pose_valid:
        return "The robot does not know its position relative to the Car."
    if before is not None and before.car and before.car_frame != status.car_frame:
        return "The Car coordinate system was corrected during the measurement."
    return ""


def _robot_trouble(status: RobotStatus) -> str:
    for notification in status.notifications:
        if notification.code in _FAULT_CODES:
            return f"The robot had a fault: {notification.text}"
    return ""


def _car_trouble(car_link: CarLink) -> str:
    if car_link.problem:
        return car_link.problem
    if car_link.lock_state is LockState.UNKNOWN:
        return "The Car does not say whether it is locked."
    return ""
