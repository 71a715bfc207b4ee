"""The least strength of a press to which the Car answers each time, found by pressing and watching its locks.

From weak to strong, lock and unlock in turn, for each answer changes what the next press has to do. A strength counts
when several presses in a row are answered; one that is not has the next strength tried.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import PressReport, RobotStatus
from mtr_operator.domain.scenarios.press.button import changing_button

from ..links.idle_loop import CalibrationRequest

FIRST_STRENGTH, STEP, FULL_STRENGTH = 0.2, 0.1, 1.0
# Both buttons twice: a strength that works three times out of four is told apart with 68 %.
IN_A_ROW = 4
# Robot time after a press for which an answer is waited for, and until the next press; and for the robot's own report.
ANSWER_LIMIT_S, REST_S, REPORT_LIMIT_S = 2.0, 1.0, 5.0


class PressEnd(enum.Enum):
    """How a search ended."""

    FOUND = "found"
    NO_ANSWER = "no answer"
    LOCKS_UNKNOWN = "locks unknown"
    NOT_PRESSED = "not pressed"
    REFUSED = "refused"
    STOPPED = "stopped"


class PressSearch:
    """press_s: how long a button is held down.

    Attributes:
        strength: of the press under way, and the one that was found. presses: made so far.
        end: how it ended, None while it goes on. error: what the robot says of a press that it refused.
    """

    def __init__(self, press_s: float):
        self._press_s = press_s
        self._before = LockState.UNKNOWN
        self._sent_s = math.nan
        self._rest_until_s = -math.inf
        self._answered = 0
        self.strength = FIRST_STRENGTH
        self.presses = 0
        self.end: PressEnd | None = None
        self.error = ""

    def stop(self) -> None:
        """The Operator has stopped the robot, or does not want to go on."""
        self.end = self.end or PressEnd.STOPPED

    def learn(self, status: RobotStatus, locks: LockState) -> CalibrationRequest | None:
        """What is to be asked of the robot now, with a Status and the Car's locks at its time; None for nothing."""
        if self.end is not None:
            return None
        if locks is LockState.UNKNOWN:
            self.end = PressEnd.LOCKS_UNKNOWN
            return None
        if not math.isnan(self._sent_s):
            self._await(status, locks)
        is_free = self.end is None and math.isnan(self._sent_s)
        return self._press(status, locks) if is_free and status.stamp_s >= self._rest_until_s else None

    def _press(self, status: RobotStatus, locks: LockState) -> CalibrationRequest:
        self._before, self._sent_s = locks, status.stamp_s
        self.presses += 1
        return CalibrationRequest(None, (changing_button(locks),), self.strength, self._press_s)

    def _await(self, status: RobotStatus, locks: LockState) -> None:
        report = next((press for press in reversed(status.presses) if press.start_s > self._sent_s), None)
        if report is None:
            if status.stamp_s - self._sent_s > REPORT_LIMIT_S + self._press_s:
                self.end = PressEnd.NOT_PRESSED
        elif report.error:
            self.end, self.error = PressEnd.REFUSED, report.error
        elif locks is not self._before:
            self._learn_answer(report)
        elif status.stamp_s > report.end_s + ANSWER_LIMIT_S:
            self._learn_silence(status)

    def _learn_answer(self, report: PressReport) -> None:
        self._sent_s, self._rest_until_s = math.nan, report.end_s + REST_S
        self._answered += 1
        if self._answered == IN_A_ROW:
            self.end = PressEnd.FOUND

    def _learn_silence(self, status: RobotStatus) -> None:
        self._sent_s, self._answered = math.nan, 0
        if self.strength >= FULL_STRENGTH:
            self.end = PressEnd.NO_ANSWER
        self.strength = round(min(self.strength + STEP, FULL_STRENGTH), 3)
        self._rest_until_s = status.stamp_s
