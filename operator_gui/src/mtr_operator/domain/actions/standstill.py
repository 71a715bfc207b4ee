"""Notices that the application did not run for a while: the computer slept, or the process was stopped.

Nobody has seen meanwhile what robot and Car did, and nobody was there to stop anything. The robot has stopped by
itself; it shall not move again because somebody opens a lid.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time
from typing import Callable

# The two clocks are read one after the other, and no computer sleeps for less.
MIN_SLEEP_S = 1.0


def since_boot_s() -> float:
    """Wall time that goes on while the computer sleeps, which time.monotonic() does not on Linux; s from anywhere."""
    clock = getattr(time, "CLOCK_BOOTTIME", None)
    return time.monotonic() if clock is None else time.clock_gettime(clock)


class Standstill:
    """Asked again and again by whatever has to go on.

    limit_s: wall time between two looks that is too much although the computer was awake. monotonic: a clock that may
    stand while it sleeps; since_boot: one that does not; both in s.
    """

    def __init__(self, limit_s: float, monotonic: Callable[[], float] = time.monotonic,
                 since_boot: Callable[[], float] = since_boot_s):
        self._limit_s = limit_s
        self._monotonic = monotonic
        self._since_boot = since_boot
        self._awake_s, self._passed_s = monotonic(), since_boot()

    def look(self) -> str:
        """What happened since the look before, a sentence; empty when nothing did."""
        awake_s, passed_s = self._monotonic(), self._since_boot()
        ran_s, gone_s = awake_s - self._awake_s, passed_s - self._passed_s
        self._awake_s, self._passed_s = awake_s, passed_s
        if gone_s - ran_s >= MIN_SLEEP_S:
            return f"The laptop slept for {gone_s:.0f} s, and the robot stood meanwhile."
        if gone_s > self._limit_s:
            return f"The application stood still for {gone_s:.0f} s, and the robot stood meanwhile."
        return ""
