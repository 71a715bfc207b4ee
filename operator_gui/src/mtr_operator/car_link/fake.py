"""Substitute of the Car: a timer on the robot's clock, and a random number against a threshold at each turn.

Once a button was pressed or the handle taken, those are the turns and the timer rests: a Car whose locks move in
between can only be measured as invalid.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import random

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import OUTPUT, CarEvent, CarLink, HandlePort, LockState
from mtr_operator.domain.robot_status import RobotStatus

_TIME_SIGMA_S = 0.005
# A press is obeyed this long after its beginning, at its end at the latest.
_REACTION_S = 0.1
# A person tries again where a press failed, so that a test finds some places that work.
_OBEYED = 0.5
_OTHER_STATE = {LockState.LOCKED: LockState.UNLOCKED, LockState.UNLOCKED: LockState.LOCKED}


class FakeHandle(HandlePort):
    """An output that is there at once.

    Attributes:
        is_waiting: it was taken, and the Car has not looked yet.
    """

    by = OUTPUT

    def __init__(self) -> None:
        self.is_waiting = False
        self._is_taken = False

    def request(self, distance_m: float) -> None:
        """See HandlePort."""
        self.is_waiting = self._is_taken = True

    def is_taken(self) -> bool:
        """See HandlePort."""
        return self._is_taken

    def release(self) -> None:
        """See HandlePort."""
        self._is_taken = False


class FakeCarLink(CarLink):
    """Between connect() and close() the locks change at each turn of the timer whose random number is below threshold.

    The same seed and the same Statuses give the same events. threshold: probability of a change per turn, 0 to 1.
    """

    def __init__(self, seed: int = 1, threshold: float = 0.15, period_s: float = 1.0):
        if not 0.0 <= threshold <= 1.0:
            raise InvalidParameter(f"Parameter threshold is {threshold:g}; allowed is 0 to 1.")
        if not period_s > 0.0:
            raise InvalidParameter(f"Parameter period_s is {period_s:g} s; allowed is more than 0 s.")
        self._chance = random.Random(seed)
        self._threshold = threshold
        self._period_s = period_s
        self._is_active = False
        self._turn_s = math.nan
        self._state = LockState.LOCKED
        self._pressed_s = -math.inf
        self._observed_s = -math.inf
        self._handle = FakeHandle()

    def connect(self) -> None:
        """See CarLink."""
        self._is_active = True

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink."""
        if not self._is_active:
            return []
        if math.isnan(self._turn_s):
            self._turn_s = status.stamp_s + self._period_s
        events = self._answers(status) + self._handle_answers()
        self._observed_s = status.stamp_s
        while self._turn_s <= status.stamp_s:
            if self._pressed_s == -math.inf and self._chance.random() < self._threshold:
                events.append(self._change(self._turn_s))
            self._turn_s += self._period_s
        return events

    def _answers(self, status: RobotStatus) -> list[CarEvent]:
        events = []
        for press in sorted(status.presses, key=lambda press: press.start_s):
            if press.start_s > self._pressed_s and not press.error:
                self._pressed_s = press.start_s
                if self._chance.random() < _OBEYED:
                    events.append(self._change(min(press.start_s + _REACTION_S, press.end_s)))
        return events

    def _handle_answers(self) -> list[CarEvent]:
        """A hand that came since the last Status; like a press it ends the timer's turns."""
        if not self._handle.is_waiting:
            return []
        self._handle.is_waiting, asked_s = False, self._observed_s
        self._pressed_s = max(self._pressed_s, asked_s)
        if self._state is LockState.UNLOCKED or self._chance.random() >= _OBEYED:
            return []
        return [self._change(asked_s + _REACTION_S)]

    def _change(self, time_s: float) -> CarEvent:
        self._state = _OTHER_STATE[self._state]
        return CarEvent(time_s, _TIME_SIGMA_S, self._state)

    @property
    def lock_state(self) -> LockState:
        """See CarLink."""
        return self._state if self._is_active else LockState.UNKNOWN

    @property
    def handle(self) -> HandlePort | None:
        """See CarLink."""
        return self._handle

    @property
    def problem(self) -> str:
        """See CarLink."""
        return "" if self._is_active else "The Car's substitute is not connected."

    def close(self) -> None:
        """See CarLink."""
        self._is_active = False
        self._turn_s = math.nan
