"""How long a Status waits for the frames that precede it, by the wall clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

# Of a bus from which frames come; they are late by the adapter, its driver and the thread that reads it.
LIMIT_S = 0.25
# Of one that was late at the Status before, while the robot's time goes on. Who waited each time for a bus that is dead
# would fall behind the ten Statuses a second, and the robot would stop because its Operator is silent.
LATE_LIMIT_S = 0.02
# Of an adapter that was asked, while the robot's time stands still: its word comes, however busy the machine is.
SETTLED_LIMIT_S = 5.0


class CatchUp:
    """Of one bus. changed: notified whenever something has come from it."""

    def __init__(self, changed: threading.Condition):
        self._changed = changed
        self._is_late = False

    def wait(self, is_here: Callable[[], bool], stands: bool, ask: Callable[[], Callable[[], bool] | None]) -> None:
        """With the condition held, until the frames are here, or nothing tells that they will come.

        stands: the robot's time stands still meanwhile, so that no later frame tells that all are here. ask: has the
        adapter say a word behind them, and gives what tells that it was said; None where it has no such word.
        """
        settled = ask() if stands and not is_here() else None
        if settled is None:
            limit_s = LATE_LIMIT_S if self._is_late and not stands else LIMIT_S
            self._is_late = not self._changed.wait_for(is_here, limit_s)
        else:
            limit_s = LIMIT_S if self._is_late else SETTLED_LIMIT_S
            self._is_late = not self._changed.wait_for(lambda: is_here() or settled(), limit_s)
