"""The mailbox of a worker under test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time

from mtr_operator.station.mailbox import Mailbox

LIMIT_S, TOTAL_LIMIT_S = 30.0, 120.0


class Post:
    """Mailbox whose events can be waited for."""

    def __init__(self):
        self.events, self._arrived = [], threading.Event()
        self.box = Mailbox(self._arrived.set)

    def wait_for(self, kind):
        """The first event of a kind that was not taken yet."""
        deadline = time.monotonic() + TOTAL_LIMIT_S
        while True:
            for event in self.events:
                if isinstance(event, kind):
                    self.events.remove(event)
                    return event
            # Statuses of the robot alone do not prolong it.
            assert time.monotonic() < deadline, f"no {kind.__name__}; there were {self.events}"
            self.take(f"no {kind.__name__}")

    def take(self, missing="nothing"):
        """Wait for something, an event or a Status, and keep the events."""
        assert self._arrived.wait(LIMIT_S), f"{missing}; there were {self.events}"
        self._arrived.clear()
        self.events += self.box.take().events
