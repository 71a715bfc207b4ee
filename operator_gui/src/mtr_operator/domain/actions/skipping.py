"""The line that is being measured, and whether the Operator wants it skipped."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from .trouble import LineSkipped


class Skipping:
    """Asked by any thread, obeyed once in the run's: a request for a line that is over by then skips no other.

    Attributes: is_skipped: the line that was begun last was left for the Operator's request.
    """

    def __init__(self) -> None:
        self._wanted = self._at_hand = 0
        self.is_skipped = False

    @property
    def is_measuring(self) -> bool:
        """True while a line is measured."""
        return bool(self._at_hand)

    def skip(self, number: int) -> None:
        """Leave the line with this number, from 1, if it is the one at hand."""
        self._wanted = number

    def begin(self, number: int) -> None:
        """A line is measured from now on; what was asked before is over."""
        self._wanted, self._at_hand, self.is_skipped = 0, number, False

    def end(self) -> None:
        """No line is measured any more."""
        self._at_hand = 0

    def look(self) -> None:
        """Raise LineSkipped, once, when the line at hand is to be left."""
        if self._at_hand and self._wanted == self._at_hand:
            self._wanted, self.is_skipped = 0, True
            raise LineSkipped
