"""Comparison of a clock with the laptop's monotonic clock: detects steps of the clock, and stamps that were not late.

A stamp arrives with a delay and never early. The clock was therefore set if a stamp is ahead of the best recent one by
more than the clocks drift apart, or if all stamps of one second are behind it.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import itertools
import math
from typing import NamedTuple

_WINDOW_S = 10.0
# The best stamp of each piece of this length is stored.
_PIECE_S = 0.1
# All stamps must be late for this time before it counts as a backward step. Wi-Fi interruptions and stalls of the
# laptop end with a stamp that is in time.
_PATIENCE_S = 1.0
_MIN_STAMPS = 5


class _Piece(NamedTuple):
    begin_s: float
    ahead_s: float
    stamps: int


class DelayWatch:
    """Step detector for two clocks that run at true rate.

    step_s: smallest detected step, larger than the differences of the least delays in the window; clocks 200 ppm apart
    drift 2 ms in it.

    Attributes:
        in_time_s, in_time_arrival_s: newest stamp with about the least delay, and its arrival. A newer stamp may be
            late, or the clock was set back: both are possible until more stamps arrive.
    """

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self._pieces: collections.deque[_Piece] = collections.deque()
        self._best_s = -math.inf
        self.in_time_s = self.in_time_arrival_s = -math.inf

    def add(self, stamp_s: float, arrival_s: float, may_be_late: bool = False) -> bool:
        """Add a stamp of the clock; return True if the clock was set since the previous one, which restarts the watch.

        may_be_late: lateness is not evidence, because the source reports its own backward steps.
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
        """True if all stamps of the patience time were late; stamps delayed by a stall arrive together, the last one in
        time."""
        late = list(itertools.takewhile(lambda piece: piece.ahead_s < self._best_s - self._step_s,
                                        reversed(self._pieces)))
        return (bool(late) and arrival_s - late[-1].begin_s >= _PATIENCE_S
                and sum(piece.stamps for piece in late) >= _MIN_STAMPS)
