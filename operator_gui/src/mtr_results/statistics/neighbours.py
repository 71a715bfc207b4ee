"""Neighbouring lines that have moved together: what an antenna moves, and chance does not.

An antenna reaches some lines beside each other and not a whole side. So each run of two neighbouring lines of a side or
more, and all lines together, is looked at where all tests have passes at the same speeds (same_passes.py): the mean of
its differences over its sigma, T. The largest T is judged by how often the largest of all runs is as large where
nothing has moved, which draws tell, as runs have lines in common (Westfall and Young 1993, Resampling-Based Multiple
Testing, 2.3: one step, the maximum). Its interval is that of all runs at once.

The noise of a pass is told by all lines together, for each word: lines of one side alone tell it so badly that much of
what can be found is lost to Student's t. A word counts by the inverse of its variance. What a test has alike for all
lines counts beside it; where several tests of a set are farther apart in the mean of all lines than the noise allows
(F-test at 5 %), that is their spread.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np
from scipy.special import fdtrc

from mtr_operator.history.estimate import Estimate

from .change import Change
from .multiplicity import ALPHA
from .same_passes import Events, Floats, estimate_of, spread_of, summed

_MIN_LINES = 2
# Draws tell a chance of 5 % to 0.3 %; their seed is always the same, so that a comparison is repeatable.
_DRAWS, _SEED = 20000, 1
# By number of line, what of each word was measured there.
OfLines = Mapping[int, Sequence[Events]]


@dataclass(frozen=True)
class Neighbours:
    """Attributes: numbers: of the lines that moved most against their sigma. first, second: mean of both sets."""

    numbers: tuple[int, ...]
    first: Estimate
    second: Estimate
    change: Change


@dataclass(frozen=True)
class _Noise:
    """Attributes: variances: of the mean over the speeds on one line in one test, by word. freedoms: of each."""

    variances: Floats
    freedoms: Floats

    @property
    def weights(self) -> Floats:
        """Of the words."""
        inverse = 1.0 / self.variances
        return np.asarray(inverse / np.sum(inverse))

    @property
    def of_line(self) -> tuple[float, float]:
        """Variance of the weighted mean on one line in one test, with degrees of freedom (Welch and Satterthwaite)."""
        parts = self.weights ** 2 * self.variances
        return float(np.sum(parts)), float(np.sum(parts) ** 2 / np.sum(parts ** 2 / self.freedoms))


def moved_most(events: OfLines, sides: Sequence[Sequence[int]], split: int, lasting: float) -> Neighbours | None:
    """Of all runs the one with the largest T; None where there is none, or no noise to hold it against.

    events: of lines on which all tests have the same passes, of all words. sides: numbers of their lines, in order.
    lasting: as in same_passes.moved.
    """
    runs = [run for side in sides for run in _runs(side, events)]
    noise = _noise(list(events.values()))
    if not runs or noise is None:
        return None
    if len(events) >= _MIN_LINES:
        runs.append(tuple(events))
    lasting = max(lasting, _scatter(_means(events, tuple(events), noise), split, noise, len(events)))
    values, sigmas = _differences(events, runs, noise, split, lasting)
    freedom = noise.of_line[1]
    largest = int(np.argmax(np.abs(values) / sigmas))
    reach, chance = _judged(tuple(runs), tuple(events), freedom, abs(values[largest]) / sigmas[largest])
    value, low = float(values[largest]), float(reach * sigmas[largest])
    means = _means(events, runs[largest], noise)
    first, second = (estimate_of(part, summed(noise.of_line[0] / len(runs[largest]) / len(part), freedom,
                                              lasting ** 2)) for part in (means[:split], means[split:]))
    return Neighbours(runs[largest], first, second, Change(value, value - low, value + low, chance))


def _runs(side: Sequence[int], events: OfLines) -> list[tuple[int, ...]]:
    """Of a side, without a gap."""
    return [tuple(side[first:last]) for first in range(len(side)) for last in range(first + _MIN_LINES, len(side) + 1)
            if all(number in events for number in side[first:last])]


def _noise(lines: Sequence[Sequence[Events]]) -> _Noise | None:
    variances, freedoms = [], []
    for of_word in zip(*lines):
        squares, freedom = (sum(each) for each in zip(*(line.noise for line in of_word)))
        per_line = float(np.mean([1.0 / line.distances_m.shape[1] for line in of_word]))
        variances.append(squares / freedom * per_line)
        freedoms.append(float(freedom))
    return _Noise(np.array(variances), np.array(freedoms)) if variances and min(variances) > 0.0 else None


def _means(events: OfLines, run: Sequence[int], noise: _Noise) -> Floats:
    """Of each test over the lines of a run, words by their weights."""
    means = np.array([[each.means_m for each in events[number]] for number in run])
    return np.asarray(np.tensordot(noise.weights, np.mean(means, axis=0), axes=1))


def _scatter(means: Floats, split: int, noise: _Noise, lines: int) -> float:
    """1 sigma in which the tests of a set differ for all lines alike, of the mean of a set; 0 where that is noise."""
    sides = means[:split], means[split:]
    variance, freedom = noise.of_line
    spread, of_spread = spread_of(sides)
    if not of_spread or float(fdtrc(of_spread, freedom, spread * lines / variance)) >= ALPHA:
        return 0.0
    return math.sqrt(spread / min(map(len, sides)))


def _differences(events: OfLines, runs: Sequence[Sequence[int]], noise: _Noise, split: int,
                 lasting: float) -> tuple[Floats, Floats]:
    """Difference and sigma of each run."""
    variance, values, sigmas = noise.of_line[0], [], []
    for run in runs:
        means = _means(events, run, noise)
        sides = means[:split], means[split:]
        values.append(float(np.mean(sides[1]) - np.mean(sides[0])))
        sigmas.append(math.sqrt(sum(variance / len(run) / len(side) for side in sides) + 2.0 * lasting ** 2))
    return np.array(values), np.array(sigmas)


def _judged(runs: tuple[tuple[int, ...], ...], lines: tuple[int, ...], freedom: float,
            largest: float) -> tuple[float, float]:
    """Within how many sigmas the largest T of all runs stays in 95 % of the draws, and how often it is as large."""
    drawn = _largest(tuple(tuple(lines.index(number) for number in run) for run in runs), len(lines))
    scaled = drawn / np.sqrt(np.random.default_rng(_SEED + 1).chisquare(freedom, _DRAWS) / freedom)
    return float(np.quantile(scaled, 1.0 - ALPHA)), float((np.sum(scaled >= largest) + 1) / (_DRAWS + 1))


@functools.lru_cache(maxsize=16)
def _largest(runs: tuple[tuple[int, ...], ...], lines: int) -> Floats:
    """The largest T of all runs in each draw, where sigma is known."""
    draws = np.random.default_rng(_SEED).standard_normal((_DRAWS, lines))
    return np.asarray(np.max([np.abs(np.sum(draws[:, run], axis=1)) / math.sqrt(len(run)) for run in map(list, runs)],
                             axis=0))
