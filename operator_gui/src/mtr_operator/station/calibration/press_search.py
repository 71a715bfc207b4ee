"""Search for the least strength of a press to which the Car reacts each time, by pressing and watching its locks.

From weak to strong, with lock and unlock in turn, because each reaction changes the effect of the next press. A
strength counts if several consecutive presses succeed; after a failure the next strength is tried.
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
# Both buttons twice: a strength that works three times out of four is detected with 68 %.
IN_A_ROW = 4
# Robot times: limit for the reaction to a press, rest until the next press, limit for the robot's own report.
ANSWER_LIMIT_S, REST_S, REPORT_LIMIT_S = 2.0, 1.0, 5.0


class PressEnd(enum.Enum):
    """End of a search."""

    FOUND = "found"
    NO_ANSWER = "no answer"
    LOCKS_UNKNOWN = "locks unknown"
    NOT_PRESSED = "not pressed"
    REFUSED = "refused"
    STOPPED = "stopped"


class PressSearch:
    """State of the search. press_s: duration of a press.

    Attributes:
        strength: of the current press, or the result. presses: made so far.
        end: result of the search, None while it continues. error: the robot's reason for rejecting a press.
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
        """End the search because the Operator has stopped the robot or cancelled."""
        self.end = self.end or PressEnd.STOPPED

    def learn(self, status: RobotStatus, locks: LockState) -> CalibrationRequest | None:
        """Return the next request to the robot, from a Status and the Car's locks at its time; None without one."""
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
