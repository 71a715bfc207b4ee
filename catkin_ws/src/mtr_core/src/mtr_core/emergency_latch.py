"""Latch for emergency stops with silent owners; the same rule as in drive control's motion_locks.hpp."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict

from .liveness import is_fresh


class EmergencyLatch:
    """Owners whose emergency stop counts as engaged.

    An emergency stop whose owner fell silent while it was engaged is released only after the owner has engaged and then
    released it. So a restarted process without knowledge of the stop cannot release it.
    """

    def __init__(self, timeout_s: float):
        """timeout_s: age of an owner's message at which the owner counts as silent."""
        self._timeout_s = timeout_s
        # Time of the newest message with an engaged stop by owner.
        self._engaged_s: Dict[str, float] = {}

    def take(self, owner: str, engaged: bool, said_s: float) -> None:
        """Process an owner's message of this time of the steady clock in s."""
        if engaged:
            self._engaged_s[owner] = said_s
        elif owner in self and is_fresh(said_s - self._engaged_s[owner], self._timeout_s):
            del self._engaged_s[owner]

    def __contains__(self, owner: str) -> bool:
        return owner in self._engaged_s
