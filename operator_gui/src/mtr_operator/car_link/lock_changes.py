"""Changes of the Car's locks, and doubtful frames, from the readings of the lock message."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
from dataclasses import dataclass, replace

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.refused import Refused

from .frame_judge import FrameJudge
from .profile import CarProfile, LockReading

# Intervals outside these parts of the cycle mean that a frame was delayed in the adapter or the laptop.
_EVEN_CYCLES = (0.5, 1.5)
# Without Statuses no change is released, and a link that is silent for this long makes each line invalid anyway.
_KEPT_CHANGES = 1000


@dataclass(frozen=True)
class Change:
    """A change of the locks, a doubtful frame, or both.

    is_timed: its time is known, because no clock was set meanwhile. is_event: False for a return from an unknown state.
    """

    local_s: float
    previous_local_s: float
    arrival_s: float
    reading: LockReading
    is_timed: bool = True
    doubt: str = ""
    is_event: bool = True


class LockChanges:
    """Queue of changes, updated with every reading.

    Attributes:
        waiting: changes in their order.
        first: state of the first reading, UNKNOWN before it.
        refused: rejected frames.
    """

    def __init__(self, profile: CarProfile, refused: Refused):
        """refused: rejected frames before this."""
        self._profile = profile
        self._judge = FrameJudge(profile)
        self._state: LockState | None = None
        self._known: LockState | None = None
        self._state_s = self._before_s = math.nan
        self.first = LockState.UNKNOWN
        self.refused = refused
        self.waiting: collections.deque[Change] = collections.deque(maxlen=_KEPT_CHANGES)

    @property
    def is_repeated(self) -> bool:
        """True if the newest reading repeats the previous frame: a gateway that repeats its last frame counts as
        silent."""
        return self._judge.is_repeated

    def begin_new_time(self) -> None:
        """Handle a clock step: changes that were not released have no valid time."""
        self.waiting = collections.deque((replace(change, is_timed=False) for change in self.waiting),
                                         maxlen=_KEPT_CHANGES)

    def begin_new_frames(self) -> None:
        """Handle a step of the frames' clock: earlier frames have no time on it."""
        self.begin_new_time()
        self._state_s = math.nan
        self._judge = FrameJudge(self._profile)

    def doubt(self, local_s: float, arrival_s: float, sentence: str) -> None:
        """Record a doubt about a message other than the lock message."""
        self.refused = Refused(self.refused.count + 1, sentence)
        state = LockState.UNKNOWN if self._state is None else self._state
        self.waiting.append(Change(local_s, local_s, arrival_s, LockReading(state), doubt=sentence))

    def follow(self, local_s: float, arrival_s: float, reading: LockReading, may_have_waited: bool) -> None:
        """Add a reading; may_have_waited: it is timed by its arrival."""
        doubt, is_changed = self._judge.judge(reading, local_s), reading.state is not self._state
        if doubt:
            self.refused = Refused(self.refused.count + 1, doubt)
        if self._state is None:
            self.first = reading.state
            self._state_s = local_s
        elif is_changed or (doubt and not (self.waiting and self.waiting[-1].doubt)):
            self.waiting.append(Change(local_s, self._state_s, arrival_s, reading, not math.isnan(self._state_s),
                                       doubt, bool(doubt) or reading.state is not self._known))
        if not may_have_waited or self._is_even(local_s - self._before_s):
            self._state_s = local_s
        self._state, self._before_s = reading.state, local_s
        if reading.state is not LockState.UNKNOWN:
            self._known = reading.state

    def _is_even(self, gap_s: float) -> bool:
        """Return False for a delayed frame: its state may be as old as the last frame that was not delayed."""
        least, most = _EVEN_CYCLES
        return least <= gap_s / self._profile.cycle_time_s <= most
