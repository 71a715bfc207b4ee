"""State of the emergency stops for holds, from the motion locks of their owners."""
# SPDX-License-Identifier: Apache-2.0
from typing import Set

from mtr_core.names import SERVICE_MODE

from .observation import Emergency


class EmergencyWatch:
    """Processes all messages of the owners, so that an engagement between two ticks also counts.

    Silence is ignored here: drive control stops for it, and the emergency stop of a restarted owner is engaged.
    """

    def __init__(self) -> None:
        self._engaged: Set[str] = set()
        self._stops = 0

    def take(self, owner: str, engaged: bool) -> None:
        """Process the message of an emergency stop's owner."""
        if engaged and owner not in self._engaged:
            self._stops += 1
            self._engaged.add(owner)
        elif not engaged:
            self._engaged.discard(owner)

    def now(self) -> Emergency:
        """Return the newest state, and the number of engagements since the start."""
        return Emergency(bool(self._engaged), self._stops, SERVICE_MODE in self._engaged)
