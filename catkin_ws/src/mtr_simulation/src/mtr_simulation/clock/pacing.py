"""Relation of simulated to wall time: keeps a desired factor, and measures the actual one."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Callable, Optional

REPORT_EVERY_S = 30.0


class Pace:
    """Times in s; a factor of 0 is as fast as possible.

    Attributes:
        due_s: wall time at which the newest simulated time was due.
        lost_s: lost wall time of the loop that was not made up for.
    """

    def __init__(self, factor: float, wall_clock: Callable[[], float] = time.monotonic, made_up_s: float = 0.0):
        """made_up_s: largest lost wall time for which the loop makes up."""
        self._factor, self._wall_clock, self._made_up_s = factor, wall_clock, made_up_s
        self._start = self._report = (0.0, 0.0)
        self._newest_s = self.due_s = self.lost_s = 0.0

    def start(self, simulated_s: float) -> None:
        """Start at this simulated time."""
        self._newest_s, self.due_s = self._start = self._report = (simulated_s, self._wall_clock())

    def delay(self, simulated_s: float) -> float:
        """Return the wall time to wait before the simulated time."""
        if not self._factor:
            return 0.0
        now = self._wall_clock()
        due_s = self.due_s + (simulated_s - self._newest_s) / self._factor
        self._newest_s, self.due_s = simulated_s, max(due_s, now - self._made_up_s)
        self.lost_s += self.due_s - due_s
        return max(0.0, self.due_s - now)

    def report(self, simulated_s: float) -> Optional[str]:
        """Return a sentence every 30 simulated seconds."""
        begun, wall = self._report
        if simulated_s - begun < REPORT_EVERY_S:
            return None
        self._report = (simulated_s, self._wall_clock())
        return _sentence(simulated_s - begun, self._report[1] - wall)

    def total(self, simulated_s: float) -> str:
        """Return a sentence about the whole run."""
        begun, wall = self._start
        return _sentence(simulated_s - begun, self._wall_clock() - wall)


def _sentence(simulated_s: float, wall_s: float) -> str:
    factor = simulated_s / wall_s if wall_s > 0.0 else 0.0
    return f"Simulated {simulated_s:.1f} s in {wall_s:.1f} s: {factor:.1f} x real time"
