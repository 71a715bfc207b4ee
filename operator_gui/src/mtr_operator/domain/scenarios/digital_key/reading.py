"""What a feed told while the robot stood at a place, and whether that is to be believed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import Sequence

from ...distance_feed import Reported
from ...estimation.ranging.changes import MIN_CHANGES, changed_values
from ...estimation.ranging.median import Median, median_of
from ...limits import DISTANCE_SIGMA
from .parameters import DigitalKeyParameters

# Two clocks may differ in rate by so much; of a laptop's and a phone's quartz each some 50 ppm.
_DRIFT = 200e-6
# A clock that goes on by so much more than the robot's was set; less is a figure that came late.
_JUMP_S = 1.0
# Stamps of figures that are computed side by side may be so much out of order.
_DISORDER_S = 0.01


class Answer(enum.Enum):
    """What came of a place."""

    NOT_MEASURED = ""       # the robot did not stand there undisturbed
    DISTANCE = "distance"
    NONE = "none"           # too little was told
    STALE = "stale"         # what was told was old
    CLOCK = "clock"         # the feed's clock was set
    CONSTANT = "constant"   # it did not change, too rarely, or is the same at places that are farther or nearer


@dataclass(frozen=True)
class Reading:
    """reason: why it is not to be believed; empty when it is. age_s: of the newest figure, at its greatest; None when
    nothing came. median: None as well then."""

    answer: Answer
    figures_m: tuple[float, ...]
    median: Median | None
    age_s: float | None
    reason: str = ""


def read(heard: Sequence[Reported], window_s: tuple[float, float], parameters: DigitalKeyParameters) -> Reading:
    """heard: all figures of the last while in their order. window_s: robot times between which the robot stood."""
    start_s, end_s = window_s
    inside = [index for index, each in enumerate(heard) if start_s < each.time_s <= end_s]
    figures_m = tuple(heard[index].distance_m for index in inside)
    duration_s = end_s - start_s
    if len(inside) < parameters.minimum_samples:
        reason = f"The phone's distance was told {len(inside)} times within {duration_s:.1f} s; " \
                 f"{parameters.minimum_samples} times are needed."
        return Reading(Answer.NONE, figures_m, None, None, reason)
    jumps_s, delays_s = _by_clock(heard)
    # A figure of known age may have been measured before the robot stood there.
    values_m = changed_values([heard[index].distance_m for index in inside
                               if heard[index].time_s - delays_s[index] > start_s])
    median = median_of(values_m, parameters.resolution_m) if len(values_m) > 1 else None
    if median is not None and not DISTANCE_SIGMA.allows(median.sigma_m):
        return Reading(Answer.NONE, figures_m, None, None,
                       f"The phone's distances scatter by {median.spread_m:.1f} m; their median is not known.")
    jump_s = max((jumps_s[index] for index in inside), key=abs)
    if jump_s:
        return Reading(Answer.CLOCK, figures_m, median, None, _clock_reason(jump_s))
    age_s = _greatest_age(heard, delays_s, inside, window_s)
    if age_s > parameters.maximum_age_s:
        return Reading(Answer.STALE, figures_m, median, age_s,
                       f"The newest distance of the phone was {age_s:.1f} s old while it was read; allowed are "
                       f"{parameters.maximum_age_s:g} s.")
    needed = max(parameters.minimum_samples, MIN_CHANGES)
    if len(values_m) < needed:
        return Reading(Answer.CONSTANT, figures_m, None, age_s, _unchanged_reason(len(values_m), needed, duration_s))
    return Reading(Answer.DISTANCE, figures_m, median, age_s)


def _clock_reason(jump_s: float) -> str:
    way = "forward" if jump_s > 0.0 else "back"
    return f"The clock of the phone's distance was set {way} by {abs(jump_s):.1f} s."


def _unchanged_reason(changes: int, needed: int, duration_s: float) -> str:
    """A frozen feed, or a phone that measures too rarely for the time in which it is read."""
    often = "" if not changes else " more than once" if changes == 1 else f" more than {changes} times"
    return (f"The phone's distance did not change{often} within {duration_s:.1f} s; {needed} changes are needed. "
            "Increase reading_time_s, or check the phone.")


def _greatest_age(heard: Sequence[Reported], delays_s: Sequence[float], inside: Sequence[int],
                  window_s: tuple[float, float]) -> float:
    """Just before each new figure, and at the end of the window, the one before is as old as it gets."""
    start_s, end_s = window_s
    until_s = [*(heard[index].time_s for index in inside), end_s]
    ages_s = (after_s - heard[index].time_s + delays_s[index] for index, after_s in zip(inside, until_s[1:]))
    return max(until_s[0] - start_s, *ages_s)


def _by_clock(heard: Sequence[Reported]) -> tuple[list[float], list[float]]:
    """Of each figure by how many seconds the feed's clock was set before it, and how old it was when it was known: as
    it says itself, and by how much it came later than the quickest one of the same clock did."""
    jumps_s, delays_s = [], []
    quickest_s, before = math.inf, None
    for each in heard:
        jump_s = late_s = 0.0
        if each.feed_s is not None:
            offset_s = each.time_s - each.feed_s
            if before is not None and before.feed_s is not None:
                quickest_s += _DRIFT * (each.time_s - before.time_s)
                went_back = each.feed_s < before.feed_s - _DISORDER_S
                if went_back or offset_s < quickest_s - _JUMP_S:
                    expected_s = before.time_s - before.feed_s if went_back else quickest_s
                    jump_s, quickest_s = expected_s - offset_s, math.inf
            quickest_s, before = min(quickest_s, offset_s), each
            late_s = offset_s - quickest_s
        jumps_s.append(jump_s)
        delays_s.append(each.age_s + late_s)
    return jumps_s, delays_s
