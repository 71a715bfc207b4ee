"""Plausibility check of the lock message, frame by frame: repetitions, jumps and contradictions to its counters.

The result is a sentence, empty if the frame is consistent with the previous ones. Only counters and flags that the
profile declares are checked.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.ports import LockState

from .further.counting import CountWatch
from .profile import CarProfile, LockReading

# A state in fewer frames than this is a glitch, at any cycle time.
_MIN_FRAMES = 2


class FrameJudge:
    """Check with the state of the previous frames; a new judge accepts the first frame.

    Attributes:
        is_repeated: the last frame repeats an old one, which a node on the bus sends again.
    """

    def __init__(self, profile: CarProfile):
        self.is_repeated = False
        self._profile = profile
        self._last: LockReading | None = None
        self._last_s = math.nan
        self._known: LockState | None = None
        self._since_s = -math.inf
        self._frames = _MIN_FRAMES
        self._counts = {name: CountWatch(profile.counts(name), name == profile.alive_signal)
                        for name in (profile.alive_signal, profile.command_signal) if name}

    def judge(self, reading: LockReading, local_s: float) -> str:
        """Return why this frame is doubtful; empty if it is not. local_s: of the clock that stamps the frames."""
        last, is_change = self._last, self._known not in (None, reading.state)
        doubt, self.is_repeated = "", False
        if last is not None:
            doubt = (self._order(local_s) or self._alive(last, reading) or self._state(reading)
                     or self._commands(last, reading, is_change) or self._flag(last, reading, is_change)
                     or self._flicker(local_s, is_change))
        self._remember(reading, local_s, is_change)
        return doubt

    def _remember(self, reading: LockReading, local_s: float, is_change: bool) -> None:
        self._last, self._last_s = reading, local_s
        if reading.state is LockState.UNKNOWN:
            return
        if is_change:
            self._since_s, self._frames = local_s, 0
        self._known = reading.state
        self._frames += 1

    def _order(self, local_s: float) -> str:
        if local_s < self._last_s:
            return f"A frame of the Car's lock message came {self._last_s - local_s:.3f} s after a later one."
        if local_s == self._last_s:
            self.is_repeated = True
            return "A frame of the Car's lock message came twice."
        return ""

    def _alive(self, last: LockReading, reading: LockReading) -> str:
        if last.alive is None or reading.alive is None:
            return ""
        name = self._profile.alive_signal
        before, now = (self._profile.counts(name).unsigned(each) for each in (last.alive, reading.alive))
        step = self._counts[name].step(before, now)
        if step == 0:
            self.is_repeated = True
            return f"The signal {name} of the Car's lock message stands still at {now}."
        if step == 1:
            return ""
        return f"The signal {name} of the Car's lock message went from {before} to {now}."

    def _state(self, reading: LockReading) -> str:
        if reading.state is not LockState.UNKNOWN:
            return ""
        return f"The signal {self._profile.signal} of the Car's lock message has the unknown value {reading.raw}."

    def _commands(self, last: LockReading, reading: LockReading, is_change: bool) -> str:
        if last.commands is None or reading.commands is None:
            return ""
        name = self._profile.command_signal
        before, now = (self._profile.counts(name).unsigned(each) for each in (last.commands, reading.commands))
        step = self._counts[name].step(before, now)
        if step is None:
            return f"The signal {name} of the Car's lock message went from {before} to {now}."
        if is_change and step == 0 and last.state is not LockState.UNKNOWN:
            return f"The Car was {reading.state.value} on its bus, and {name} counted no command."
        return ""

    def _flag(self, last: LockReading, reading: LockReading, is_change: bool) -> str:
        if reading.changed is None or last.changed is None:
            return ""
        name = self._profile.changed_signal
        if is_change and not reading.changed:
            return f"The Car was {reading.state.value} on its bus, and {name} said nothing of a change."
        if reading.changed and not last.changed and not is_change:
            return f"{name} told of a change, and the Car stayed {reading.state.value} on its bus."
        return ""

    def _flicker(self, local_s: float, is_change: bool) -> str:
        is_long = local_s - self._since_s >= self._profile.min_state_s - self._slack_s
        if not is_change or (is_long and (self._frames >= _MIN_FRAMES or self._profile.is_only_on_change)):
            return ""
        lasted_s = max(local_s - self._since_s, 0.0)
        return (f"The Car changed its locks on its bus after {lasted_s:.3f} s; a state lasts at least "
                f"{self._profile.min_state_s:g} s and {_MIN_FRAMES} frames.")

    @property
    def _slack_s(self) -> float:
        # Frames show a change with a delay of up to one cycle.
        return 0.0 if self._profile.is_only_on_change else self._profile.cycle_time_s
