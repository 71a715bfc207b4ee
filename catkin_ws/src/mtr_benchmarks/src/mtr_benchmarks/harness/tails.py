"""The 99th percentile of what takes longer with something than without, measured in turns. No robot inside."""
# SPDX-License-Identifier: Apache-2.0
import random
from typing import List, NamedTuple, Sequence

SHARE = 0.99
# Resampled sets of turns, of which the middle 95 % make the interval.
RESAMPLED, TAIL = 2000, 0.025


class Turn(NamedTuple):
    """Delays without it (an attack, encryption) and with it, one after the other, s."""

    without_s: List[float]
    with_s: List[float]


class Ratio(NamedTuple):
    """The 99th percentile with it against that without, with its 95 % interval, and both, s."""

    value: float
    low: float
    high: float
    with_s: float
    without_s: float


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
    with_s, without_s = _tails(turns)
    return Ratio(with_s / without_s, percentile(drawn, TAIL), percentile(drawn, 1.0 - TAIL), with_s, without_s)


def _ratio(turns: Sequence[Turn]) -> float:
    with_s, without_s = _tails(turns)
    return with_s / without_s


def _tails(turns: Sequence[Turn]) -> List[float]:
    return [percentile([delay for turn in turns for delay in turn[kind]], SHARE) for kind in (1, 0)]
