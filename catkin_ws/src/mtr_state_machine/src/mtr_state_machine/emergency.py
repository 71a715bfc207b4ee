"""Emergency stops, by the motion locks of their owners, as far as a hold needs them."""
# SPDX-License-Identifier: Apache-2.0
from typing import Set

from .observation import Emergency


class EmergencyWatch:
    """Takes the words of all owners; one that is short of a tick counts, too.

    Silence counts as nothing here: drive control stops for it, and an owner that was started anew begins engaged.
    """

    def __init__(self) -> None:
        self._engaged: Set[str] = set()
        self._stops = 0

    def take(self, owner: str, engaged: bool) -> None:
        """An owner of an emergency stop says how it stands."""
        if engaged and owner not in self._engaged:
            self._stops += 1
            self._engaged.add(owner)
        elif not engaged:
            self._engaged.discard(owner)

    def now(self) -> Emergency:
        """What was said last, and how often one was engaged since the start."""
        return Emergency(bool(self._engaged), self._stops)
