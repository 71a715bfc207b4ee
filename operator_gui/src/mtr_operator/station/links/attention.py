"""Notices that the view takes nothing any more: its thread hangs, and its Stop with it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time
from typing import Callable

# The view takes four times a second at least what has come, and 0.7 s of work for another language block it longest.
LIMIT_S = 1.0
# Two looks are nearer to each other, unless the whole application stood: then the view has had no time either.
_MAX_STEP_S = 0.5


class Attention:
    """Asked again and again by the thread that has the robot move.

    taken: how often the view has taken what has come. clock: steady, s.
    """

    def __init__(self, taken: Callable[[], int], clock: Callable[[], float] = time.monotonic):
        self._taken = taken
        self._clock = clock
        self._seen, self._looked_s = taken(), clock()
        self._absent_s = 0.0

    def look(self) -> str:
        """What is wrong, a sentence, as long as it is; empty when nothing is."""
        taken, now_s = self._taken(), self._clock()
        passed_s = min(now_s - self._looked_s, _MAX_STEP_S)
        self._absent_s = 0.0 if taken != self._seen else self._absent_s + passed_s
        self._seen, self._looked_s = taken, now_s
        if self._absent_s >= LIMIT_S:
            return f"The window did not react for {LIMIT_S:.0f} s, nor would its Stop have: the robot was stopped."
        return ""
