"""Figures of times that were measured. No robot inside."""
# SPDX-License-Identifier: Apache-2.0
import random
from typing import List, NamedTuple, Sequence

SHARE = 0.99
# Resampled sets of turns, of which the middle 95 % make the interval.
RESAMPLED, TAIL = 2000, 0.025


class Turn(NamedTuple):
    """Delays without an attack and beside it, one after the other, s."""

    quiet_s: List[float]
    beside_s: List[float]


class Ratio(NamedTuple):
    """The 99th percentile beside an attack against that without, with its 95 % interval, and both, s."""

    value: float
    low: float
    high: float
    beside_s: float
    quiet_s: float


def percentile(values: Sequence[float], share: float) -> float:
    """The smallest value below which that share of them lies; ValueError for none."""
    if not values:
        raise ValueError("No value was measured.")
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)]


def ratio_of(turns: Sequence[Turn]) -> Ratio:
    """Over all turns; the interval by drawing whole turns again and again, for delays of one turn are alike."""
    chance = random.Random(1)
    drawn = [_ratio([chance.choice(turns) for _ in turns]) for _ in range(RESAMPLED)]
    beside_s, quiet_s = _tails(turns)
    return Ratio(beside_s / quiet_s, percentile(drawn, TAIL), percentile(drawn, 1.0 - TAIL), beside_s, quiet_s)


def _ratio(turns: Sequence[Turn]) -> float:
    beside_s, quiet_s = _tails(turns)
    return beside_s / quiet_s


def _tails(turns: Sequence[Turn]) -> List[float]:
    return [percentile([delay for turn in turns for delay in turn[kind]], SHARE) for kind in (1, 0)]
