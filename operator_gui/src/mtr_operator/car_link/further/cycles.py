"""Compares the cycle times of a profile's messages with profile and database."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import statistics
from typing import TYPE_CHECKING, Iterator

from ..can_frame import CanFrame

if TYPE_CHECKING:
    from ..profile import CarProfile

# Times of frames scatter; their median over this number of gaps is stable.
_GAPS = 20
# Cycles with at least this ratio count as different.
_RATIO = 1.5
_MS_PER_S = 1000.0


class CycleCheck:
    """Cycle check, updated with every frame of the bus of the state. profile: None checks nothing."""

    def __init__(self, profile: CarProfile | None = None):
        self._expected: dict[tuple[int, bool], tuple[str, float, str]] = {}
        self._times_s: dict[tuple[int, bool], collections.deque[float]] = {}
        if profile is not None:
            self._expect(profile)

    def _expect(self, profile: CarProfile) -> None:
        for place in profile.further.places():
            cycle_ms = place.message.cycle_time
            if not place.bus and cycle_ms:
                self._expected[place.key[1:]] = place.message.name, cycle_ms / _MS_PER_S, "its database"
        if profile.poll is None and not profile.is_only_on_change:
            message = profile.message
            self._expected[message.frame_id, message.is_extended_frame] = (
                message.name, profile.cycle_time_s, "cycle_time_s of the car profile")
        self._times_s = {key: collections.deque(maxlen=_GAPS + 1) for key in self._expected}

    def frame(self, frame: CanFrame, local_s: float) -> None:
        """Add a frame with its time by the clock that times the frames: simulated ones arrive faster."""
        times_s = self._times_s.get((frame.can_id, frame.is_extended))
        if times_s is not None:
            times_s.append(local_s)

    @property
    def notices(self) -> tuple[str, ...]:
        """Return a sentence for each message with an unexpected cycle."""
        return tuple(self._notices())

    def _notices(self) -> Iterator[str]:
        for key, known_s in self._times_s.items():
            name, expected_s, source = self._expected[key]
            if len(known_s) <= _GAPS:
                continue
            times_s = list(known_s)
            measured_s = statistics.median(after - before for before, after in zip(times_s, times_s[1:]))
            if not expected_s / _RATIO < measured_s < _RATIO * expected_s:
                yield (f"Message {name} comes every {measured_s:.3g} s, and {source} says {expected_s:.3g} s; the "
                       "uncertainty of a change rests on it: correct it.")
