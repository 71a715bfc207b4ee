"""Offset of the robot's clock from this laptop's: irrelevant for measurements, but needed to compare logs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
import time
from typing import Callable

from ..robot_status import RobotStatus
from .clock_step import clock_was_set
from .simulated_time import is_simulated

# Above all delays of a working Wi-Fi; dates of two logs within this offset are compared by eye.
MAX_OFFSET_S = 1.0
# Five seconds of Status: the Status with the least delay arrives early, and a step of the laptop's clock expires as
# fast.
_KEPT = 50
_S_PER_MIN, _MIN_PER_H, _H_PER_DAY = 60, 60, 24
# Durations up to this are shown in seconds.
_LONGEST_IN_S = 90.0


class ClockOffset:
    """Offset, updated with every Status at its arrival. wall_clock: the laptop's time of day, s since 1970."""

    def __init__(self, wall_clock: Callable[[], float] = time.time):
        self._wall_clock = wall_clock
        self._ahead_s: collections.deque[float] = collections.deque(maxlen=_KEPT)
        self._before: RobotStatus | None = None

    @property
    def ahead_s(self) -> float:
        """Robot's clock less the laptop's; NaN before a Status, and for a robot with simulated time.

        The transmission delay of a Status makes the robot's clock appear late, so the least delay counts.
        """
        return max(self._ahead_s, default=math.nan)

    def learn(self, status: RobotStatus) -> None:
        """Add a Status that has just arrived; a restarted robot, or a clock that was set, restarts the estimate."""
        before, self._before = self._before, status
        if before is not None and (before.robot_session_id != status.robot_session_id or clock_was_set(before, status)):
            self._ahead_s.clear()
        if not math.isnan(status.sent_s) and not is_simulated(status):
            self._ahead_s.append(status.sent_s - self._wall_clock())


def are_apart(ahead_s: float) -> bool:
    """Return True if the offset matters for the comparison of dates; False for NaN, an unknown one."""
    return abs(ahead_s) > MAX_OFFSET_S


def offset_sentence(ahead_s: float) -> str:
    """Return a sentence for the Operator on clocks that are apart; empty otherwise."""
    if not are_apart(ahead_s):
        return ""
    side = "ahead of" if ahead_s > 0 else "behind"
    return (f"The robot's clock is {span_text(abs(ahead_s))} {side} this laptop's: distances do not depend on it, "
            "dates in the robot's logs do; set the one that is wrong, or have the laptop take the robot's "
            "(docs/robot-setup.md, Clocks).")


def span_text(seconds: float) -> str:
    """Return a text such as "4.2 s", "9 min", "1 h 5 min", "2 d 3 h"."""
    if seconds < _LONGEST_IN_S:
        return f"{seconds:.1f} s"
    minutes = round(seconds / _S_PER_MIN)
    hours, minutes = divmod(minutes, _MIN_PER_H)
    if not hours:
        return f"{minutes} min"
    days, hours_of_day = divmod(hours, _H_PER_DAY)
    return f"{days} d {hours_of_day} h" if days else f"{hours} h {minutes} min"
