"""Compares the 99th percentiles of delays with and without a condition, measured alternately. No robot inside."""
# SPDX-License-Identifier: Apache-2.0
import random
from typing import List, NamedTuple, Sequence

SHARE = 0.99
# Number of bootstrap samples of turns; the middle 95 % of their ratios form the interval.
RESAMPLED, TAIL = 2000, 0.025


class Turn(NamedTuple):
    """Delays without the condition (an attack, encryption) and with it, measured one after the other, s."""

    without_s: List[float]
    with_s: List[float]


class Ratio(NamedTuple):
    """Ratio of the 99th percentiles with and without the condition, its 95 % interval, and both percentiles, s."""

    value: float
    low: float
    high: float
    with_s: float
    without_s: float


def percentile(values: Sequence[float], share: float) -> float:
    """Return the smallest value below which the given share of the values lies.

    Raises:
        ValueError: the sequence is empty.
    """
    if not values:
        raise ValueError("No value was measured.")
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)]


def ratio_of(turns: Sequence[Turn]) -> Ratio:
    """Return the ratio over all turns. The bootstrap draws whole turns, because delays within a turn are correlated."""
    chance = random.Random(1)
    drawn = [_ratio([chance.choice(turns) for _ in turns]) for _ in range(RESAMPLED)]
    with_s, without_s = _tails(turns)
    return Ratio(with_s / without_s, percentile(drawn, TAIL), percentile(drawn, 1.0 - TAIL), with_s, without_s)


def _ratio(turns: Sequence[Turn]) -> float:
    with_s, without_s = _tails(turns)
    return with_s / without_s


def _tails(turns: Sequence[Turn]) -> List[float]:
    return [percentile([delay for turn in turns for delay in turn[kind]], SHARE) for kind in (1, 0)]
