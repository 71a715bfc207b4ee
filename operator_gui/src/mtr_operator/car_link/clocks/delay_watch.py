"""One clock against the laptop's monotonic one: notices when it was set, and which stamps were not late.

A stamp arrives late by its way and never early. So one that is ahead of the best of the last while by more than the
clocks drift apart, or a second in which all are behind it, says that the clock was set.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import itertools
import math
from typing import NamedTuple

_WINDOW_S = 10.0
# The best stamp of each such piece is kept.
_PIECE_S = 0.1
# That long all stamps have to be late before it is taken for a step backwards: interruptions of the Wi-Fi and stalls of
# the laptop end with a stamp that is in time.
_PATIENCE_S = 1.0
_MIN_STAMPS = 5


class _Piece(NamedTuple):
    begin_s: float
    ahead_s: float
    stamps: int


class DelayWatch:
    """Both clocks run at true rate.

    step_s: smallest step that is noticed, more than the least delays of pieces of the window differ by; clocks 200 ppm
    apart drift 2 ms in it.

    Attributes:
        in_time_s, in_time_arrival_s: the newest stamp that was under way about as long as the fastest, and its arrival.
            What is newer may be late, or the clock was set back: that cannot be told yet.
    """

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self._pieces: collections.deque[_Piece] = collections.deque()
        self._best_s = -math.inf
        self.in_time_s = self.in_time_arrival_s = -math.inf

    def add(self, stamp_s: float, arrival_s: float, may_be_late: bool = False) -> bool:
        """A stamp of the clock arrived; True when the clock was set since the one before, and all begins anew.

        may_be_late: being late tells nothing, for who stamps says himself when he was set back.
        """
        ahead_s = stamp_s - arrival_s
        if ahead_s > self._best_s + self._step_s and self._pieces:
            return self._begin(ahead_s, arrival_s)
        self._keep(ahead_s, arrival_s)
        if ahead_s >= self._best_s - self._step_s:
            self.in_time_s, self.in_time_arrival_s = stamp_s, arrival_s
        return not may_be_late and self._is_behind(arrival_s) and self._begin(ahead_s, arrival_s)

    def _begin(self, ahead_s: float, arrival_s: float) -> bool:
        self._pieces.clear()
        self._best_s = -math.inf
        self._keep(ahead_s, arrival_s)
        return True

    def _keep(self, ahead_s: float, arrival_s: float) -> None:
        pieces = self._pieces
        if pieces and arrival_s - pieces[-1].begin_s < _PIECE_S:
            last = pieces[-1]
            pieces[-1] = _Piece(last.begin_s, max(last.ahead_s, ahead_s), last.stamps + 1)
        else:
            pieces.append(_Piece(arrival_s, ahead_s, 1))
            while arrival_s - pieces[0].begin_s > _WINDOW_S:
                pieces.popleft()
            self._best_s = max(piece.ahead_s for piece in pieces)
        self._best_s = max(self._best_s, ahead_s)

    def _is_behind(self, arrival_s: float) -> bool:
        """All of some time was late; what a stall held back comes at once, and the last of it in time."""
        late = list(itertools.takewhile(lambda piece: piece.ahead_s < self._best_s - self._step_s,
                                        reversed(self._pieces)))
        return (bool(late) and arrival_s - late[-1].begin_s >= _PATIENCE_S
                and sum(piece.stamps for piece in late) >= _MIN_STAMPS)
