"""Sequence of learning: a time of rest, then the person is prompted to lock and unlock the Car in turn."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockState

from .recording import Recording, Stay

# Signals that change by themselves do so within this time.
REST_S = 5.0
# Doors need some tenths of a second, and slow messages another second to report the state.
SETTLE_S = 0.7
STAY_S = 2.0
DEFAULT_PROMPTS, MIN_PROMPTS, MAX_PROMPTS = 10, 4, 40


class Stage(enum.Enum):
    """Stages: the adapter is being opened; the Car is at rest; the person is prompted; the Car is left alone; the
    recording is complete."""

    OPENING = "opening"
    REST = "rest"
    ASKED = "asked"
    STAY = "stay"
    COMPLETE = "complete"


class LearnSession:
    """Sequence of the prompts. Times are of the laptop's monotonic clock in s.

    prompts: number of prompts; even, so that both states have the same weight.

    Attributes: recording: frames of the bus. stage. number: of the current prompt, from 1.
    """

    def __init__(self, prompts: int = DEFAULT_PROMPTS):
        if not MIN_PROMPTS <= prompts <= MAX_PROMPTS or prompts % 2:
            raise InvalidParameter(f"The number of prompts is {prompts}; allowed are even numbers from {MIN_PROMPTS} "
                                   f"to {MAX_PROMPTS}.")
        self.prompts = prompts
        self.recording = Recording()
        self.stage = Stage.OPENING
        self.number = 1
        self._next_s = self._asked_s = 0.0

    def begin(self, now_s: float) -> None:
        """Start when the adapter is open."""
        self.stage, self._next_s = Stage.REST, now_s + REST_S

    @property
    def wanted(self) -> LockState:
        """State that the person is asked to produce; locked first."""
        return LockState.LOCKED if self.number % 2 else LockState.UNLOCKED

    def left_s(self, now_s: float) -> float:
        """Return the time until the current stage ends by itself; 0 in stages that do not."""
        return max(self._next_s - now_s, 0.0) if self.stage in (Stage.REST, Stage.STAY) else 0.0

    def tick(self, now_s: float) -> Stage:
        """Advance the time and return the current stage."""
        if self.stage in (Stage.REST, Stage.STAY) and now_s >= self._next_s:
            if self.stage is Stage.STAY:
                begin_s = self._next_s - STAY_S
                self.recording.stays.append(Stay(self.wanted, self._asked_s, begin_s, self._next_s))
                self.number += 1
            self._asked_s = now_s
            self.stage = Stage.ASKED if self.number <= self.prompts else Stage.COMPLETE
        return self.stage

    def done(self, now_s: float) -> None:
        """Record that the Car is in the requested state; without a prompt it has no effect."""
        if self.stage is Stage.ASKED:
            self.stage, self._next_s = Stage.STAY, now_s + SETTLE_S + STAY_S
