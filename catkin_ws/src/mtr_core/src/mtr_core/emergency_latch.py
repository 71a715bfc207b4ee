"""Emergency stops that nobody was seen to release; the rule of drive control's motion_locks.hpp."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict

from .liveness import is_fresh


class EmergencyLatch:
    """Owners whose emergency stop counts as engaged.

    One that fell silent while it was engaged is released only when its owner engages it and then releases it, so that a
    new process that knows nothing of it releases nothing.
    """

    def __init__(self, timeout_s: float):
        """timeout_s: age of an owner's word at which it counts as silent."""
        self._timeout_s = timeout_s
        # When each was last said to be engaged.
        self._engaged_s: Dict[str, float] = {}

    def take(self, owner: str, engaged: bool, said_s: float) -> None:
        """Take an owner's word, said at this time of the steady clock in s."""
        if engaged:
            self._engaged_s[owner] = said_s
        elif owner in self and is_fresh(said_s - self._engaged_s[owner], self._timeout_s):
            del self._engaged_s[owner]

    def __contains__(self, owner: str) -> bool:
        return owner in self._engaged_s
