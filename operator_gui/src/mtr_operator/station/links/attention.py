"""Detects a view that no longer takes events: its thread hangs, and its Stop with it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time
from typing import Callable

# The view takes events at least four times a second; its longest block is 0.7 s, for a change of the language.
LIMIT_S = 1.0
# A longer interval between two checks means that the whole application was stopped, and so was the view.
_MAX_STEP_S = 0.5


class Attention:
    """Watch that the thread which moves the robot checks periodically.

    taken: number of times that the view has taken its events. clock: steady, s.
    """

    def __init__(self, taken: Callable[[], int], clock: Callable[[], float] = time.monotonic):
        self._taken = taken
        self._clock = clock
        self._seen, self._looked_s = taken(), clock()
        self._absent_s = 0.0

    def look(self) -> str:
        """Return a sentence while the view hangs; empty otherwise."""
        taken, now_s = self._taken(), self._clock()
        passed_s = min(now_s - self._looked_s, _MAX_STEP_S)
        self._absent_s = 0.0 if taken != self._seen else self._absent_s + passed_s
        self._seen, self._looked_s = taken, now_s
        if self._absent_s >= LIMIT_S:
            return f"The window did not react for {LIMIT_S:.0f} s, nor would its Stop have: the robot was stopped."
        return ""
