"""Shift of events between passes at the same speeds: mean of a side without a model of the Car's timing.

The static boundary of a test depends on an estimate of the Car's timing, whose error is common to all its lines. A
single pass does not have this error: on the same line and at the same speed, the same Car reacts at the same place on
average. The difference of two such events equals the difference of the boundaries.

The noise of a pass is estimated from the tests themselves. On a line, the differences between tests must be the same at
each speed; the remainder is noise,
    s^2 = sum over tests t, speeds p of (x_tp - x_t. - x_.p + x_..)^2 / ((tests - 1) (speeds - 1)).
The variance of the mean over the speeds is s^2 / speeds, also if the speeds have different variances. Lines of a side
count with their own noise, pooled for each word, with Student's t.

An error common to all lines of a test but not to other tests (calibration of the robot, outline of another Car) is
added. Several tests of a set show whether this is sufficient: if their means differ more than both explain (F-test at 5
%), only their spread is used.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np
import numpy.typing as npt
from scipy.special import fdtrc

from mtr_operator.domain.estimation.student import quantile
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.history.estimate import Estimate

from .difference import Difference
from .multiplicity import ALPHA, chance

Floats = npt.NDArray[np.float64]
# Relative difference below which two speeds are the same; a robot keeps its speed to a few percent.
_SAME_SPEED = 0.05
_MIN_SPEEDS = 2


@dataclass(frozen=True)
class Events:
    """Events of one line and word: distances in m, axes [test, speed]; each speed occurs once."""

    distances_m: Floats

    @property
    def means_m(self) -> Floats:
        """Mean of each test over the speeds."""
        return np.asarray(np.mean(self.distances_m, axis=1))

    @property
    def noise(self) -> tuple[float, int]:
        """Sum of squares that neither test nor speed explains, and its degrees of freedom."""
        x = self.distances_m
        rest = x - x.mean(axis=1, keepdims=True) - x.mean(axis=0, keepdims=True) + x.mean()
        return float(np.sum(rest ** 2)), (x.shape[0] - 1) * (x.shape[1] - 1)


def events_of(results: Sequence[LineResult], word: str) -> Events | None:
    """Return the events of a line at the speeds at which each test has a pass; None for fewer than two speeds."""
    passes = [_by_speed(getattr(result, "passes", lambda _word: ())(word)) for result in results]
    rows = [[next((distance_m for its_mps, distance_m in each.items() if _is_same(speed_mps, its_mps)), None)
             for each in passes] for speed_mps in passes[0]]
    kept = [[distance_m for distance_m in row if distance_m is not None] for row in rows if None not in row]
    return Events(np.array(kept).T) if len(kept) >= _MIN_SPEEDS else None


def _by_speed(passes: Sequence[tuple[float, float]]) -> Mapping[float, float]:
    """Return the distance of each speed in m: the first pass at a speed, without passes in steps."""
    found: dict[float, float] = {}
    for distance_m, speed_mps in passes:
        if speed_mps > 0.0 and not any(_is_same(speed_mps, other) for other in found):
            found[speed_mps] = distance_m
    return found


def _is_same(first_mps: float, second_mps: float) -> bool:
    return abs(first_mps - second_mps) <= _SAME_SPEED * max(first_mps, second_mps)


def moved(words: Sequence[Sequence[Events]], split: int, lasting: float) -> tuple[Estimate, Estimate, Difference]:
    """Return the means over the lines of all words in the first tests and in the others, and their difference.

    words: lines of each word, at least one. split: number of first tests. lasting: 1 sigma of the error that all lines
    of a test have in common, and other tests may not have.
    """
    count = sum(map(len, words))
    means = np.sum([each.means_m for lines in words for each in lines], axis=0) / count
    sides = means[:split], means[split:]
    noise, freedom = _variance_of_test(words, count)
    spread, of_spread = spread_of(sides)
    if of_spread and noise > 0.0 and float(fdtrc(of_spread, freedom, spread / noise)) < ALPHA:
        noise, freedom = spread, float(of_spread)
    first, second = (estimate_of(side, summed(noise / len(side), freedom, lasting ** 2)) for side in sides)
    value = float(np.mean(sides[1]) - np.mean(sides[0]))
    sigma, freedom = summed(sum(noise / len(side) for side in sides), freedom, 2.0 * lasting ** 2)
    reach = quantile(freedom) * sigma
    return first, second, Difference(value, value - reach, value + reach,
                                     chance(value, value - reach, value + reach, freedom))


def _variance_of_test(words: Sequence[Sequence[Events]], count: int) -> tuple[float, float]:
    """Return the variance of a test's mean from the noise of its passes, with Welch-Satterthwaite freedom."""
    parts = []
    for lines in words:
        squares, freedom = (sum(each) for each in zip(*(line.noise for line in lines)))
        per_line = np.mean([1.0 / line.distances_m.shape[1] for line in lines])
        parts.append((squares / freedom * float(per_line) * len(lines) / count ** 2, freedom))
    total = sum(variance for variance, _ in parts)
    bound = sum(variance ** 2 / freedom for variance, freedom in parts)
    return total, total ** 2 / bound if bound > 0.0 else math.inf


def summed(variance: float, freedom: float, known: float) -> tuple[float, float]:
    """Return sigma including a known variance, and the resulting degrees of freedom."""
    total = variance + known
    return math.sqrt(total), freedom * (total / variance) ** 2 if variance > 0.0 else math.inf


def spread_of(sides: Sequence[Floats]) -> tuple[float, int]:
    """Return the variance of test means within their side, with degrees of freedom; 0 for single tests."""
    freedom = sum(len(side) - 1 for side in sides)
    squares = sum(float(np.sum((side - np.mean(side)) ** 2)) for side in sides)
    return (squares / freedom if freedom else 0.0), freedom


def estimate_of(means_m: Floats, known: tuple[float, float]) -> Estimate:
    value, count, (sigma, freedom) = float(np.mean(means_m)), len(means_m), known
    reach = quantile(freedom) * sigma
    return Estimate(value, value - reach, value + reach, count, freedom,
                    float(np.std(means_m, ddof=1)) if count > 1 else None)
