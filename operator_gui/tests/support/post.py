"""The mailbox of a worker under test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading

from mtr_operator.station.mailbox import Mailbox

LIMIT_S = 30.0


class Post:
    """Mailbox whose events can be waited for."""

    def __init__(self):
        self.events, self._arrived = [], threading.Event()
        self.box = Mailbox(self._arrived.set)

    def wait_for(self, kind):
        """The first event of a kind that was not taken yet."""
        while True:
            for event in self.events:
                if isinstance(event, kind):
                    self.events.remove(event)
                    return event
            assert self._arrived.wait(LIMIT_S), f"no {kind.__name__}; there were {self.events}"
            self._arrived.clear()
            self.events += self.box.take().events
