"""Signal before motion: a robot at rest drives off only after people nearby were warned."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_core.problems import NO_PROBLEM, Problem

from . import problems
from .observation import Observation

# Order, board and report need three ticks of 0.1 s; after this time the signal counts as missing.
NOT_GIVEN_AFTER_S = 2.0


class MotionSignal:
    """Delays a new goal until the board has reported the signal for signal_s without a gap.

    Motion within one goal needs no signal, nor does a goal that follows the last motion within after_rest_s.

    Attributes:
        is_due: the goal waits, and the signal is ordered.
    """

    def __init__(self, signal_s: float, after_rest_s: float):
        self._signal_s, self._after_rest_s = signal_s, after_rest_s
        self._rests_since_s = -math.inf
        self._ordered_s = self._given_s = math.nan
        self.is_due = False

    def update(self, seen: Observation, begins: bool) -> None:
        """Process an observation; begins: the robot wants to start a new goal."""
        if seen.drive.is_moving:
            self._rests_since_s = seen.now_s
        rests_long = seen.now_s - self._rests_since_s >= self._after_rest_s
        self.is_due = begins and rests_long and self._signal_s > 0.0 and not self._is_given(seen)
        if not self.is_due:
            self._ordered_s = self._given_s = math.nan

    def problem(self, now_s: float) -> Problem:
        """Return the reason for which the robot waits."""
        if not self.is_due:
            return NO_PROBLEM
        is_missing = math.isnan(self._given_s) and now_s - self._ordered_s >= NOT_GIVEN_AFTER_S
        return problems.SIGNAL_NOT_GIVEN() if is_missing else problems.SETS_OFF()

    def _is_given(self, seen: Observation) -> bool:
        """Count the signal's time; after a complete signal the robot has signal_after_rest_s to drive off."""
        if math.isnan(self._ordered_s):
            self._ordered_s = seen.now_s
        if not seen.signals_motion:
            self._given_s = math.nan
            return False
        if math.isnan(self._given_s):
            self._given_s = seen.now_s
        if seen.now_s - self._given_s < self._signal_s:
            return False
        self._rests_since_s = seen.now_s
        return True
