"""Which waits tell most of a key's sleep time, and what its answers say of it; all in s of rest."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import Iterable

# Waits while nothing is known of the end: each is so many times the one before.
_LONGER = 2.0
# Rounding of a sum must not ask for one trial more.
_ROUNDING_S = 1e-6


class Asleep(enum.Enum):
    """Where the sleep time lies. UNKNOWN: no key is known to have answered at all."""

    MEASURED = "measured"
    SOONER = "sooner"
    LATER = "later"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class WaitPlan:
    """What is wanted: see SleepTimeParameters. span_s: from the first to the last request of a trial without an answer;
    interval_s has to be more than twice of it, or halving does not end."""

    shortest_s: float
    longest_s: float
    interval_s: float
    confirmations: int
    trials_limit: int
    span_s: float


@dataclass(frozen=True)
class WaitTrial:
    """One trial. rest_s: for how long the key had been at rest when it answered, or at the last of the requests."""

    rest_s: float
    answered: bool


class Rests:
    """Attributes: trials: so far, in any order; a key that did not answer in one did so when it was moved."""

    def __init__(self, trials: Iterable[WaitTrial] = ()):
        self.trials = list(trials)

    @property
    def answered_s(self) -> list[float]:
        """Rests after which the key answered, from short to long."""
        return sorted(trial.rest_s for trial in self.trials if trial.answered)

    @property
    def unanswered_s(self) -> list[float]:
        """Rests after which it did not, not once more, from short to long."""
        return sorted(trial.rest_s for trial in self.trials if not trial.answered)

    @property
    def low_s(self) -> float | None:
        """Longest rest up to which the key always answered; None when it was asleep at the shortest one already."""
        first_silent_s = min(self.unanswered_s, default=math.inf)
        return max((rest_s for rest_s in self.answered_s if rest_s < first_silent_s), default=None)

    @property
    def high_s(self) -> float | None:
        """Shortest rest from which on it never answered; None when it answered at the longest one."""
        last_answer_s = max(self.answered_s, default=-math.inf)
        return min((rest_s for rest_s in self.unanswered_s if rest_s > last_answer_s), default=None)

    @property
    def asleep(self) -> Asleep:
        """What is known of it."""
        if self.low_s is None:
            return Asleep.UNKNOWN if self.high_s is None else Asleep.SOONER
        return Asleep.LATER if self.high_s is None else Asleep.MEASURED


class WaitSearch(Rests):
    """The same with what is wanted: see WaitPlan."""

    def __init__(self, plan: WaitPlan, trials: Iterable[WaitTrial] = ()):
        super().__init__(trials)
        self.plan = plan

    def next_wait_s(self) -> float | None:
        """Rest after which the key is asked next; None when the search has come to its end."""
        if len(self.trials) >= self.plan.trials_limit:
            return None
        if self.high_s is None:
            return self._longer()
        low_s, answered_s = self.low_s or 0.0, max(self.answered_s, default=0.0)
        # The same gap twice, unless answers contradict each other: what lies between those no further wait closes.
        below_s, above_s = max(((low_s, min(self.unanswered_s)), (answered_s, self.high_s)),
                               key=lambda gap: gap[1] - gap[0])
        if above_s - below_s > self.plan.interval_s + _ROUNDING_S:
            return (below_s + above_s) / 2.0
        return self._confirming(low_s, self.high_s)

    def _longer(self) -> float | None:
        """The key has answered after the longest rest so far."""
        plan, longest_s = self.plan, max(self.answered_s, default=None)
        if longest_s is None:
            return plan.shortest_s
        if longest_s < plan.longest_s - _ROUNDING_S:
            return min(_LONGER * longest_s, plan.longest_s)
        made = sum(rest_s >= plan.longest_s - _ROUNDING_S for rest_s in self.answered_s)
        return plan.longest_s if made < plan.confirmations else None

    def _confirming(self, low_s: float, high_s: float) -> float | None:
        """Once more at an end of the interval that has not been tried often enough."""
        plan = self.plan
        silences = [rest_s for rest_s in self.unanswered_s if high_s <= rest_s <= high_s + plan.interval_s]
        if len(silences) < plan.confirmations:
            return max(high_s - plan.span_s, low_s)
        answers = [rest_s for rest_s in self.answered_s if low_s - plan.interval_s <= rest_s <= low_s]
        return low_s if 0 < len(answers) < plan.confirmations else None


def tried(plan: WaitPlan, sleep_s: float) -> list[WaitTrial]:
    """Trials of a key that always sleeps after so long."""
    search = WaitSearch(plan)
    wait_s = search.next_wait_s()
    while wait_s is not None:
        answered = wait_s < sleep_s
        search.trials.append(WaitTrial(wait_s if answered else wait_s + plan.span_s, answered))
        wait_s = search.next_wait_s()
    return search.trials
