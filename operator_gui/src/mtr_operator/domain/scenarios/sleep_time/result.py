"""What Sleep time records of the place at which the key was held."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...results.carried import CAUSE_DOC, DOORS_DOC, KEY_NUMBER_DOC
from ...results.document import Floats, OptionalFloat, OptionalInt, Texts
from ...results.line_result import LineResult, LineStatus, MeasuredDistance, OnAxis, column, stored
from ...results.quantity import MeasuredQuantity
from .waits import Asleep, Rests

HELD, SLEEP_TIME = "held", "sleep_time"
_ASLEEP = tuple(asleep.value for asleep in Asleep)
# Far beyond any trials_limit.
_MAX_TRIALS = 1000
_DIGITS = 6


@dataclass(frozen=True)
class SleepTimeResult(OnAxis, LineResult):
    """The distance is that of the Remote key from the Car's side or corner; times are of rest, since it last moved."""

    axis: int = column("number of the axis, 1")
    side: str = column("side or corner of the Car")
    key_height_m: float = column("height of the Remote key above ground", "m")
    status: LineStatus = column("ok or invalid")
    asleep: str = column("when the key falls asleep: measured; sooner than the shortest rest tried; later than the "
                         "longest one; unknown: it never answered", default="")
    answers_until_s: OptionalFloat = column("longest rest up to which the key always answered, empty when it lies "
                                            "before the shortest one tried", "s", 1, None)
    silent_from_s: OptionalFloat = column("shortest rest from which on it never answered, empty when it lies beyond "
                                          "the longest one tried", "s", 1, None)
    trials: int = column("trials that count", default=0)
    answered_after_s: Floats = column("rests after which the key answered, from short to long", "s", 1, ())
    unanswered_after_s: Floats = column("rests after which it did not, at none of the requests, and did right after "
                                        "it was moved", "s", 1, ())
    disturbed: int = column("trials that do not count, for something disturbed them", default=0)
    requested_by: str = column("who took the handle: output or operator", default="")
    distance_m: OptionalFloat = column("Remote key from the Car's side or corner while it was held", "m", default=None)
    uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m", default=None)
    robot_time_s: OptionalFloat = column("robot's clock at the last trial", "s", 3, None)
    cause: str = column(f"what unlocked the Car: {CAUSE_DOC}", default="")
    key_number: OptionalInt = column(f"of cause: {KEY_NUMBER_DOC}", default=None)
    doors: str = column(f"of the newest answer: {DOORS_DOC}", default="")
    reason: str = stored("")
    evidence: Texts = stored(())

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: where the key was held."""
        return (MeasuredDistance(HELD, self.status, self.distance_m, self.uncertainty_m),)

    @property
    def quantities(self) -> tuple[MeasuredQuantity, ...]:
        """See LineResult: between these rests the key fell asleep."""
        ends = (None, None) if self.status is LineStatus.INVALID else (self.answers_until_s, self.silent_from_s)
        return (MeasuredQuantity(SLEEP_TIME, *ends),)

    @property
    def findings(self) -> tuple[str, ...]:
        """See LineResult."""
        low_s, high_s = self.answers_until_s, self.silent_from_s
        if self.status is LineStatus.INVALID:
            return ()
        if low_s is None:
            return (f"asleep after {high_s:.1f} s at most",)
        if high_s is None:
            return (f"awake for at least {low_s:.1f} s",)
        return (f"asleep after {low_s:.1f} to {high_s:.1f} s",)

    @property
    def is_possible(self) -> bool:
        """See LineResult."""
        rests_s = (*self.answered_after_s, *self.unanswered_after_s)
        ends = (self.answers_until_s, self.silent_from_s)
        return (self.asleep in ("", *_ASLEEP) and self.trials == len(rests_s) <= _MAX_TRIALS
                and all(rest_s >= 0.0 for rest_s in rests_s)
                and all(end is None or end in rests_s for end in ends)
                and (self.status is LineStatus.INVALID or ends != (None, None)))


def rest_columns(rests: Rests) -> dict[str, Any]:
    """Columns of a result that follow from the trials."""
    return {"asleep": rests.asleep.value, "answers_until_s": _rounded(rests.low_s),
            "silent_from_s": _rounded(rests.high_s), "trials": len(rests.trials),
            "answered_after_s": tuple(round(rest_s, _DIGITS) for rest_s in rests.answered_s),
            "unanswered_after_s": tuple(round(rest_s, _DIGITS) for rest_s in rests.unanswered_s)}


def _rounded(value_s: float | None) -> float | None:
    return None if value_s is None else round(value_s, _DIGITS)
