"""The course of learning: a while of rest, then the Car is locked and unlocked in turn, as the person is asked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockState

from .recording import Recording, Stay

# What moves by itself shows within this time.
REST_S = 5.0
# Doors need some tenths of a second, and slow messages another second to tell it.
SETTLE_S = 0.7
STAY_S = 2.0
DEFAULT_PROMPTS, MIN_PROMPTS, MAX_PROMPTS = 10, 4, 40


class Stage(enum.Enum):
    """What happens now: the adapter is opened; nothing is touched; the person shall act; the Car is left alone; all is
    recorded."""

    OPENING = "opening"
    REST = "rest"
    ASKED = "asked"
    STAY = "stay"
    COMPLETE = "complete"


class LearnSession:
    """Fed with times of the laptop's monotonic clock in s.

    prompts: how often the person acts; an even number, for each state counts as much.

    Attributes: recording: what comes over the bus. stage. number: of the prompt at hand, from 1.
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
        """The adapter is open."""
        self.stage, self._next_s = Stage.REST, now_s + REST_S

    @property
    def wanted(self) -> LockState:
        """The state to which the person is asked to bring the Car; locked first."""
        return LockState.LOCKED if self.number % 2 else LockState.UNLOCKED

    def left_s(self, now_s: float) -> float:
        """Time until the stage at hand ends by itself; 0 in stages that do not."""
        return max(self._next_s - now_s, 0.0) if self.stage in (Stage.REST, Stage.STAY) else 0.0

    def tick(self, now_s: float) -> Stage:
        """Time has passed; the stage at hand."""
        if self.stage in (Stage.REST, Stage.STAY) and now_s >= self._next_s:
            if self.stage is Stage.STAY:
                begin_s = self._next_s - STAY_S
                self.recording.stays.append(Stay(self.wanted, self._asked_s, begin_s, self._next_s))
                self.number += 1
            self._asked_s = now_s
            self.stage = Stage.ASKED if self.number <= self.prompts else Stage.COMPLETE
        return self.stage

    def done(self, now_s: float) -> None:
        """The person says that the Car is as it was asked for; without a question it says nothing."""
        if self.stage is Stage.ASKED:
            self.stage, self._next_s = Stage.STAY, now_s + SETTLE_S + STAY_S
