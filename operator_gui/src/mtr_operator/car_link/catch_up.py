"""Wait of a Status for the frames that precede it, limited by the wall clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

# Limit for a bus that delivers frames. Their delay is caused by the adapter, its driver and the reading thread.
LIMIT_S = 0.25
# Limit for a bus that was late at the previous Status, while the robot's time advances. Waiting longer each time for a
# dead bus would fall behind ten Statuses per second, and the robot would stop because its Operator is silent.
LATE_LIMIT_S = 0.02
# Limit for an adapter that was queried while the robot's time is stopped: its answer arrives even on a busy machine.
SETTLED_LIMIT_S = 5.0


class CatchUp:
    """Wait for the frames of one bus. changed: notified at each arrival from the bus."""

    def __init__(self, changed: threading.Condition):
        self._changed = changed
        self._is_late = False

    def wait(self, is_here: Callable[[], bool], stands: bool, ask: Callable[[], Callable[[], bool] | None]) -> None:
        """Wait, with the condition held, until the frames have arrived or none can be expected.

        stands: the robot's time is stopped, so no later frame proves that all frames have arrived. ask: requests a
        marker behind the frames and returns a predicate for its arrival; None if the adapter has no marker.
        """
        settled = ask() if stands and not is_here() else None
        if settled is None:
            limit_s = LATE_LIMIT_S if self._is_late and not stands else LIMIT_S
            self._is_late = not self._changed.wait_for(is_here, limit_s)
        else:
            limit_s = LIMIT_S if self._is_late else SETTLED_LIMIT_S
            self._is_late = not self._changed.wait_for(lambda: is_here() or settled(), limit_s)
