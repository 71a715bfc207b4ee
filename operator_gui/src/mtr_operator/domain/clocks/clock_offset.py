"""How far the robot's clock is ahead of this laptop's: no measurement needs it, whoever compares logs does."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
import time
from typing import Callable

from ..robot_status import RobotStatus
from .clock_step import clock_was_set
from .simulated_time import is_simulated

# Above every delay of a Wi-Fi that works; dates of two logs within it are compared by eye.
MAX_OFFSET_S = 1.0
# Five seconds of Status: the least late of them comes at once, and a laptop's clock that was set is forgotten as soon.
_KEPT = 50
_S_PER_MIN, _MIN_PER_H, _H_PER_DAY = 60, 60, 24
# Up to here in seconds.
_LONGEST_IN_S = 90.0


class ClockOffset:
    """Fed with every Status as it arrives. wall_clock: the laptop's time of day, s since 1970."""

    def __init__(self, wall_clock: Callable[[], float] = time.time):
        self._wall_clock = wall_clock
        self._ahead_s: collections.deque[float] = collections.deque(maxlen=_KEPT)
        self._before: RobotStatus | None = None

    @property
    def ahead_s(self) -> float:
        """Robot's clock less the laptop's; NaN before a Status, and of a robot that tells simulated time.

        A Status is on its way for some time, which makes the robot's clock look late: the least late one counts.
        """
        return max(self._ahead_s, default=math.nan)

    def learn(self, status: RobotStatus) -> None:
        """A Status has arrived just now; another start of the robot, or a clock that was set, begins anew."""
        before, self._before = self._before, status
        if before is not None and (before.robot_session_id != status.robot_session_id or clock_was_set(before, status)):
            self._ahead_s.clear()
        if not math.isnan(status.sent_s) and not is_simulated(status):
            self._ahead_s.append(status.sent_s - self._wall_clock())


def are_apart(ahead_s: float) -> bool:
    """True when whoever compares dates has to know of the offset; False for NaN, an unknown one."""
    return abs(ahead_s) > MAX_OFFSET_S


def offset_sentence(ahead_s: float) -> str:
    """What the Operator has to know of clocks that are apart; empty of others."""
    if not are_apart(ahead_s):
        return ""
    side = "ahead of" if ahead_s > 0 else "behind"
    return (f"The robot's clock is {span_text(abs(ahead_s))} {side} this laptop's: distances do not depend on it, "
            "dates in the robot's logs do; set the one that is wrong, or have the laptop take the robot's "
            "(docs/robot-setup.md, Clocks).")


def span_text(seconds: float) -> str:
    """Such as "4.2 s", "9 min", "1 h 5 min", "2 d 3 h"."""
    if seconds < _LONGEST_IN_S:
        return f"{seconds:.1f} s"
    minutes = round(seconds / _S_PER_MIN)
    hours, minutes = divmod(minutes, _MIN_PER_H)
    if not hours:
        return f"{minutes} min"
    days, hours_of_day = divmod(hours, _H_PER_DAY)
    return f"{days} d {hours_of_day} h" if days else f"{hours} h {minutes} min"
