"""Simulated time against wall time: keeps a wanted factor, and measures the one that was reached."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Callable, Optional

REPORT_EVERY_S = 30.0


class Pace:
    """Times in s; a factor of 0 is as fast as possible."""

    def __init__(self, factor: float, wall_clock: Callable[[], float] = time.monotonic):
        self._factor, self._wall_clock = factor, wall_clock
        self._start = self._report = self._due = (0.0, 0.0)

    def start(self, simulated_s: float) -> None:
        """Begin at this simulated time."""
        self._start = self._report = self._due = (simulated_s, self._wall_clock())

    def delay(self, simulated_s: float) -> float:
        """Wall time to wait before the simulated time; time that the loop lost is not made up for."""
        if not self._factor:
            return 0.0
        begun, wall = self._due
        now = self._wall_clock()
        due = wall + (simulated_s - begun) / self._factor
        self._due = (simulated_s, max(due, now))
        return max(0.0, due - now)

    def report(self, simulated_s: float) -> Optional[str]:
        """A sentence each 30 simulated seconds."""
        begun, wall = self._report
        if simulated_s - begun < REPORT_EVERY_S:
            return None
        self._report = (simulated_s, self._wall_clock())
        return _sentence(simulated_s - begun, self._report[1] - wall)

    def total(self, simulated_s: float) -> str:
        """A sentence for the whole run."""
        begun, wall = self._start
        return _sentence(simulated_s - begun, self._wall_clock() - wall)


def _sentence(simulated_s: float, wall_s: float) -> str:
    factor = simulated_s / wall_s if wall_s > 0.0 else 0.0
    return f"Simulated {simulated_s:.1f} s in {wall_s:.1f} s: {factor:.1f} x real time"
