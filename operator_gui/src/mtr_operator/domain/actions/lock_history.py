"""Judges what the Car's locks do during a line: each change needs its opposite before it, a reason, and its time."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY, CarEvent, LockFacts, LockState
from .trouble import LineInvalid

# An event is taken for later than an instant when it may be, within 3 sigma of the two clocks.
_SIGMAS = 3.0
# The board's clock is followed to some milliseconds; a press begins a cycle of its main loop after its stamp at most.
PRESS_SIGMA_S = 0.01
# A relock timer is that of a body ECU's quartz, but it may begin with the motor's end.
_RELOCK_PART, _RELOCK_S = 0.02, 1.0
# What was measured so shortly before a doubtful change is doubtful too.
_DOUBTED_BEFORE_S = 1.0


@dataclass(frozen=True)
class Expected:
    """A change that the test provokes.

    cause: as in CarEvent. what: the same for a person, "the press at 5.00 m". after_s, until_s: window of
    robot time, without the uncertainty of the event. cause_sigma_s: 1 sigma of after_s.
    """

    state: LockState
    cause: str
    what: str
    after_s: float
    until_s: float = math.inf
    cause_sigma_s: float = 0.0


class LockHistory:
    """The changes of one line, from a known state on.

    state: when the line begins. unlocked_s: when the Car was unlocked last, None when nobody saw it.

    Attributes:
        answer: the change that was expected last, None while it has not come.
        state: after the changes so far.
    """

    def __init__(self, state: LockState, facts: LockFacts, unlocked_s: float | None = None):
        self.answer: CarEvent | None = None
        self.state = state
        self._facts = facts
        self._unlocked_s = unlocked_s
        self._expected: Expected | None = None
        self._is_open = False
        self._is_held = False
        self._may_lock = False
        self._held: list[CarEvent] = []

    def hold(self) -> None:
        """From now on changes are kept until it is known when the test provoked one; see expect."""
        self._is_held, self._is_open, self._may_lock, self.answer = True, False, False, None

    def allow_lock(self) -> None:
        """Until the next hold or expectation the Car may lock, by the test, by its timer or as the key goes away: it
        is wanted locked, and how it came to be says nothing."""
        self._expected, self._is_open, self._may_lock = None, False, True

    def expect(self, expected: Expected) -> None:
        """One change is expected from now on; LineInvalid when one that was held back does not fit."""
        self._expected, self._is_open, self._is_held, self.answer = expected, True, False, None
        self._may_lock = False
        held, self._held = self._held, []
        for event in held:
            self.take(event)

    def close(self, now_s: float) -> None:
        """No change is expected any more: whatever comes now is too late, or nobody knows why."""
        if self._expected is not None:
            until_s = min(self._expected.until_s, now_s)
            self._expected = Expected(self._expected.state, self._expected.cause, self._expected.what,
                                      self._expected.after_s, until_s)
        self._is_open = False

    def take(self, event: CarEvent) -> None:
        """One more change; LineInvalid when it may not be."""
        if event.doubt:
            raise _invalid(event, event.doubt)
        if not (math.isfinite(event.time_s) and math.isfinite(event.time_sigma_s)):
            raise _invalid(event, "Nobody knows when the Car's locks moved: the clocks were set anew.")
        if self._is_held:
            self._held.append(event)
            return
        self._check_state(event)
        expected = self._expected
        # Long after a press that stayed without an answer the Car's own timer answers for itself.
        by_timer = expected is not None and event.time_s > expected.until_s and self._relocks(event) \
            and event.source != expected.cause
        if expected is not None and expected.state is event.lock_state and self.answer is None and not by_timer:
            self._check_answer(event, expected)
            self.answer = event
        elif not self._relocks(event) and not (self._may_lock and event.lock_state is LockState.LOCKED):
            raise _invalid(event, f"The Car was {event.lock_state.value} without anything in the test to make it; "
                                  "leave its keys and doors alone during the test.")
        self._remember(event)

    def _check_state(self, event: CarEvent) -> None:
        if event.lock_state is LockState.UNKNOWN:
            raise _invalid(event, "The Car does not say whether it is locked.")
        if event.lock_state is self.state:
            raise _invalid(event, f"The Car was {event.lock_state.value} twice, without the opposite in between.")

    def _check_answer(self, event: CarEvent, expected: Expected) -> None:
        was, margin_s = event.lock_state.value, _SIGMAS * math.hypot(event.time_sigma_s, expected.cause_sigma_s)
        early_s, late_s = expected.after_s - event.time_s, event.time_s - expected.until_s
        if early_s > margin_s:
            raise _invalid(event, f"The Car was {was} {early_s:.2f} s before {expected.what}, by something else; leave "
                                  "its keys and doors alone during the test.")
        if late_s > 0.0 or not self._is_open:
            raise LineInvalid(f"The Car was {was} {max(late_s, 0.0):.2f} s too late for {expected.what}; increase "
                              "response_timeout_s if it is so slow.", since_s=expected.after_s)
        if self._relocks(event) and event.source != expected.cause:
            raise _invalid(event, f"The Car was {was} when it locks by itself anyway, so that nobody knows whether it "
                                  f"was by {expected.what}.")
        self._check_cause(event, expected)

    def _check_cause(self, event: CarEvent, expected: Expected) -> None:
        was = event.lock_state.value
        is_told = self._facts.needs_source or expected.cause in self._facts.sources
        if event.source == expected.cause or not event.source and not is_told:
            return
        if event.source == KEY_BUTTON:
            raise _invalid(event, f"The Car was {was} by the button of a key, not by {expected.what}; leave the keys "
                                  "alone during the test.")
        if event.source == PASSIVE_ENTRY:
            raise _invalid(event, f"The Car was {was} by the vicinity of a key, not by {expected.what}; switch passive "
                                  "entry off, or increase minimum_distance_m.")
        if event.source == HANDLE:
            raise _invalid(event, f"The Car was {was} by its handle, not by {expected.what}; leave its handles alone "
                                  "during the test.")
        if event.cause_raw:
            raise _invalid(event, f"The Car was {was} by something that its profile does not list ({event.cause_raw}), "
                                  f"not by {expected.what}; leave its doors and switches alone during the test.")
        raise _invalid(event, f"The Car was {was} by something that its profile does not list, not by "
                              f"{expected.what}; leave its doors and switches alone during the test.")

    def _relocks(self, event: CarEvent) -> bool:
        """True when the Car's own timer may have locked it."""
        timer_s = self._facts.relock_after_s
        if timer_s is None or self._unlocked_s is None or event.lock_state is not LockState.LOCKED:
            return False
        off_s = abs(event.time_s - self._unlocked_s - timer_s)
        return off_s <= _RELOCK_S + _RELOCK_PART * timer_s + _SIGMAS * event.time_sigma_s

    def _remember(self, event: CarEvent) -> None:
        self.state = event.lock_state
        self._unlocked_s = event.time_s if event.lock_state is LockState.UNLOCKED else None


def _invalid(event: CarEvent, reason: str) -> LineInvalid:
    return LineInvalid(reason, event.evidence, event.time_s - _DOUBTED_BEFORE_S)
