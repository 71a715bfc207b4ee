"""Detects steps of the robot's clock: exactly by its steady clock, else by the arrival of the Statuses."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.clocks.clock_step import MIN_STEP_S, clock_was_set
from mtr_operator.domain.clocks.simulated_time import is_simulated
from mtr_operator.domain.robot_status import RobotStatus

from .delay_watch import DelayWatch

# Over Wi-Fi, some Status of each piece arrives almost as fast as the fastest.
STEP_S = 0.012
# A robot without a steady clock in its Status runs at true rate if its best stamps of this many pieces agree; a
# simulation may run at any rate.
_PIECE_S = 1.0
_PIECES = 3


def sent_s(status: RobotStatus) -> float:
    """Return the send time of the Status on the robot's clock; older robots supply it only while the pose is
    invalid."""
    return status.stamp_s if math.isnan(status.sent_s) else status.sent_s


class RobotClock:
    """Step detector of the robot's clock, updated with each Status in the order of arrival.

    Attributes:
        is_real_time: the robot's clock is known to run at the rate of the laptop's; False in simulation. is_simulated:
        the robot's clock is known to be simulated.
    """

    def __init__(self) -> None:
        self.is_real_time = self.is_simulated = False
        self._before: RobotStatus | None = None
        self._delays = DelayWatch(STEP_S)
        self._rate = _RateCheck()

    def status(self, status: RobotStatus, arrival_s: float) -> bool:
        """Add a Status; return True if the clock was set since the previous one."""
        before, self._before = self._before, status
        if before is not None and (clock_was_set(before, status) or _went_back(before, status)):
            self._delays = DelayWatch(STEP_S)
            self._delays.add(sent_s(status), arrival_s)
            return True
        if math.isnan(status.steady_s):
            self.is_real_time = self.is_real_time or self._rate.add(sent_s(status), arrival_s)
        else:
            self.is_simulated = is_simulated(status)
            self.is_real_time = not self.is_simulated
        # Updated before its result is used, so that the fastest delay is known then.
        was_set = self._delays.add(sent_s(status), arrival_s, may_be_late=not math.isnan(status.steady_s))
        return was_set and self.is_real_time

    @property
    def certain_s(self) -> float:
        """Robot's time up to which no unnoticed clock step is possible."""
        by_arrivals = self.is_real_time and self._before is not None and math.isnan(self._before.steady_s)
        return self._delays.in_time_s if by_arrivals else math.inf


def _went_back(before: RobotStatus, status: RobotStatus) -> bool:
    """True if a later Status was sent earlier."""
    return status.id > before.id and sent_s(status) < sent_s(before) - MIN_STEP_S


class _RateCheck:
    """Compares the least delays of consecutive pieces of time."""

    def __init__(self) -> None:
        self._begin_s = math.nan
        self._best_s = self._best_before_s = -math.inf
        self._agreed = 0

    def add(self, stamp_s: float, arrival_s: float) -> bool:
        """Return True if the stamps run at the rate of their arrivals."""
        if math.isnan(self._begin_s):
            self._begin_s = arrival_s
        if arrival_s - self._begin_s >= _PIECE_S:
            agree = abs(self._best_s - self._best_before_s) <= STEP_S
            self._agreed = self._agreed + 1 if agree else 0
            self._begin_s, self._best_before_s, self._best_s = arrival_s, self._best_s, -math.inf
        self._best_s = max(self._best_s, stamp_s - arrival_s)
        return self._agreed >= _PIECES
