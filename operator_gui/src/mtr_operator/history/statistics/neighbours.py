"""Adjacent lines that have moved together, as by an antenna and not by chance.

An antenna affects some adjacent lines and not a whole side. So each run of at least two adjacent lines of a side, and
all lines together, are tested if all tests have passes at the same speeds (same_passes.py). The statistic T is the mean
of the differences of a run over its sigma. Runs share lines, so the largest T is compared with the distribution of the
maximum over all runs without a change, from random draws (Westfall and Young 1993, Resampling-Based Multiple Testing,
2.3: single step, maximum). Its interval is simultaneous for all runs.

The noise of a pass is estimated from all lines together, for each word. Lines of a single side have so few degrees of
freedom that Student's t would hide much of what can be found. Words are weighted by their inverse variance. An error
common to all lines of a test is added. If the means over all lines of several tests of a set differ more than the noise
allows (F-test at 5 %), this spread is used.
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

from .difference import Difference
from .multiplicity import ALPHA
from .same_passes import Events, Floats, estimate_of, spread_of, summed

_MIN_LINES = 2
# With this number, a probability of 5 % is accurate to 0.3 %. The seed is fixed, so that comparisons are repeatable.
_DRAWS, _SEED = 20000, 1
# Line number -> events of each word on that line.
OfLines = Mapping[int, Sequence[Events]]


@dataclass(frozen=True)
class Neighbours:
    """Attributes: numbers: lines of the run with the largest T. first, second: means of both sets."""

    numbers: tuple[int, ...]
    first: Estimate
    second: Estimate
    difference: Difference


@dataclass(frozen=True)
class _Noise:
    """Attributes: variances: by word, of the mean over the speeds on one line in one test. freedoms: of each
    variance."""

    variances: Floats
    freedoms: Floats

    @property
    def weights(self) -> Floats:
        """Weights of the words."""
        inverse = 1.0 / self.variances
        return np.asarray(inverse / np.sum(inverse))

    @property
    def of_line(self) -> tuple[float, float]:
        """Variance of the weighted mean on one line in one test, with degrees of freedom (Welch and Satterthwaite)."""
        parts = self.weights ** 2 * self.variances
        return float(np.sum(parts)), float(np.sum(parts) ** 2 / np.sum(parts ** 2 / self.freedoms))


def moved_most(events: OfLines, sides: Sequence[Sequence[int]], split: int, lasting: float) -> Neighbours | None:
    """Return the run with the largest T; None without a run or without a noise estimate.

    events: of lines on which all tests have the same passes, for all words. sides: line numbers of each side, in order.
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
    return Neighbours(runs[largest], first, second, Difference(value, value - low, value + low, chance))


def _runs(side: Sequence[int], events: OfLines) -> list[tuple[int, ...]]:
    """Return the runs of a side without a gap."""
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
    """Return the mean of each test over the lines of a run, with weighted words."""
    means = np.array([[each.means_m for each in events[number]] for number in run])
    return np.asarray(np.tensordot(noise.weights, np.mean(means, axis=0), axes=1))


def _scatter(means: Floats, split: int, noise: _Noise, lines: int) -> float:
    """Return 1 sigma of a set's mean from the scatter of tests that is common to all lines; 0 within the noise."""
    sides = means[:split], means[split:]
    variance, freedom = noise.of_line
    spread, of_spread = spread_of(sides)
    if not of_spread or float(fdtrc(of_spread, freedom, spread * lines / variance)) >= ALPHA:
        return 0.0
    return math.sqrt(spread / min(map(len, sides)))


def _differences(events: OfLines, runs: Sequence[Sequence[int]], noise: _Noise, split: int,
                 lasting: float) -> tuple[Floats, Floats]:
    """Return difference and sigma of each run."""
    variance, values, sigmas = noise.of_line[0], [], []
    for run in runs:
        means = _means(events, run, noise)
        sides = means[:split], means[split:]
        values.append(float(np.mean(sides[1]) - np.mean(sides[0])))
        sigmas.append(math.sqrt(sum(variance / len(run) / len(side) for side in sides) + 2.0 * lasting ** 2))
    return np.array(values), np.array(sigmas)


def _judged(runs: tuple[tuple[int, ...], ...], lines: tuple[int, ...], freedom: float,
            largest: float) -> tuple[float, float]:
    """Return the 95 % quantile of the largest T over all runs in sigmas, and the p-value of the observed one."""
    drawn = _largest(tuple(tuple(lines.index(number) for number in run) for run in runs), len(lines))
    scaled = drawn / np.sqrt(np.random.default_rng(_SEED + 1).chisquare(freedom, _DRAWS) / freedom)
    return float(np.quantile(scaled, 1.0 - ALPHA)), float((np.sum(scaled >= largest) + 1) / (_DRAWS + 1))


@functools.lru_cache(maxsize=16)
def _largest(runs: tuple[tuple[int, ...], ...], lines: int) -> Floats:
    """Return the largest T over all runs in each draw, for a known sigma."""
    draws = np.random.default_rng(_SEED).standard_normal((_DRAWS, lines))
    return np.asarray(np.max([np.abs(np.sum(draws[:, run], axis=1)) / math.sqrt(len(run)) for run in map(list, runs)],
                             axis=0))
