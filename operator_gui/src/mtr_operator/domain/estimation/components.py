"""Variance components of the spread between tests: of key, car, place ..., and of repetition.

A distance of test i is the mean, plus a random number for the level of each factor, plus a random number of its own.
The variances are estimated by restricted maximum likelihood (Patterson and Thompson 1971), which is unbiased for the
balanced tables of ISO 5725-2 and also valid for unbalanced ones; their 95 % intervals follow from the profile
likelihood. Repeatability is the spread of repetition alone, reproducibility the spread of all components together.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np
import numpy.typing as npt
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import brentq, minimize

from .interval import SIGMAS_OF_LEVEL

Floats = npt.NDArray[np.float64]
REPEAT = "repeat"
# Quantile of chi-square with one degree of freedom, the square of a normal number.
_DROP = SIGMAS_OF_LEVEL ** 2
# Limits relative to the whole spread: below a component is negligible, beyond its end is unknown.
_LEAST, _MOST = 1e-4, 1e3
# If the search ends below this part, the likelihood is flat towards zero.
_NONE = 0.01
_MIN_TESTS = 3


@dataclass(frozen=True)
class Component:
    """1 sigma of a factor, with its 95 % interval; high is infinite if the tests do not bound it."""

    factor: str
    levels: int
    sigma: float
    low: float
    high: float


@dataclass(frozen=True)
class Spread:
    """Result of the analysis. Attributes: mean: of the quantity. components: of each factor, repetition last. left_out:
    indistinguishable factors, each with a sentence. reason: why there is no result, empty if there is one."""

    count: int
    mean: float = math.nan
    components: tuple[Component, ...] = ()
    left_out: tuple[str, ...] = ()
    reason: str = ""

    @property
    def repeatability(self) -> float:
        """1 sigma of repetitions with the same car, key and place."""
        return self.components[-1].sigma if self.components else math.nan

    @property
    def reproducibility(self) -> float:
        """1 sigma with a different level of every factor."""
        return math.hypot(*(component.sigma for component in self.components)) if self.components else math.nan


def components(values: Sequence[float], factors: Mapping[str, Sequence[str]]) -> Spread:
    """Estimate the components of values, one for each test, from the level of each factor in each test."""
    if len(values) < _MIN_TESTS:
        return Spread(len(values), reason=f"{len(values)} tests have a value here; {_MIN_TESTS} are the fewest.")
    measured = np.asarray(values, dtype=np.float64)
    used, left_out = _told_apart(len(values), factors)
    scale = float(np.std(measured, ddof=1))
    if scale == 0.0:
        return Spread(len(values), float(measured[0]), left_out=left_out, reason="All tests have the same value.")
    model = _Model(measured / scale, [_shared(factors[name]) for name in used])
    found = model.best()
    parts = [Component(name, len(set(factors[name])) if name != REPEAT else len(values), scale * math.exp(found[index]),
                       *(scale * end for end in model.interval(found, index)))
             for index, name in enumerate([*used, REPEAT])]
    return Spread(len(values), scale * model.mean(found),
                  tuple(part if part.sigma > _NONE * scale else
                        Component(part.factor, part.levels, 0.0, 0.0, part.high) for part in parts), left_out)


def _told_apart(count: int, factors: Mapping[str, Sequence[str]]) -> tuple[list[str], tuple[str, ...]]:
    used: list[str] = []
    left_out = []
    for name, levels in factors.items():
        number = len(set(levels))
        twin = next((other for other in used if np.array_equal(_shared(factors[other]), _shared(levels))), None)
        if number < 2:
            left_out.append(f"{name}: all tests have the same one.")
        elif number == count:
            left_out.append(f"{name}: each test has another one, as each repetition would be.")
        elif twin:
            left_out.append(f"{name}: it changes together with {twin}.")
        else:
            used.append(name)
    return used, tuple(left_out)


def _shared(levels: Sequence[str]) -> Floats:
    """Return a matrix with 1 if two tests have the same level."""
    return np.array([[float(mine == its) for its in levels] for mine in levels])


class _Model:
    """Restricted likelihood of logarithms of the sigmas, repetition last; the values are in units of their spread."""

    def __init__(self, values: Floats, shared: Sequence[Floats]):
        self._values = values
        self._parts = [*shared, np.eye(len(values))]
        self._bounds = [(math.log(_LEAST), math.log(_MOST))] * len(self._parts)

    def loss(self, logarithms: Floats) -> float:
        """Minus twice the logarithm of the restricted likelihood."""
        factor, weights, total = self._solved(logarithms)
        rest = self._values - self._mean(weights, total)
        return float(2.0 * np.sum(np.log(np.diag(factor[0]))) + math.log(total) + rest @ cho_solve(factor, rest))

    def mean(self, logarithms: Floats) -> float:
        """Return the mean by generalized least squares."""
        _, weights, total = self._solved(logarithms)
        return self._mean(weights, total)

    def best(self, index: int | None = None, fixed: float = 0.0, start: Floats | None = None) -> Floats:
        """Return the maximum of the likelihood, optionally with a fixed component of this index."""
        begin = np.full(len(self._parts), math.log(0.5)) if start is None else start.copy()
        bounds = list(self._bounds)
        if index is not None:
            begin[index], bounds[index] = fixed, (fixed, fixed)
        return np.asarray(minimize(self.loss, begin, method="L-BFGS-B", bounds=bounds).x, dtype=np.float64)

    def interval(self, found: Floats, index: int) -> tuple[float, float]:
        """Return the sigmas at which the profile likelihood has fallen by the 95 % quantile."""
        least, most = self._bounds[index]

        def above(value: float) -> float:
            return self.loss(self.best(index, value, found)) - self.loss(found) - _DROP

        low = 0.0 if above(least) <= 0.0 else math.exp(brentq(above, least, float(found[index]), xtol=1e-3))
        high = math.inf if above(most) <= 0.0 else math.exp(brentq(above, float(found[index]), most, xtol=1e-3))
        return low, high

    def _solved(self, logarithms: Floats) -> tuple[tuple[Floats, bool], Floats, float]:
        covariance = sum(math.exp(2.0 * size) * part for size, part in zip(logarithms, self._parts))
        factor = cho_factor(covariance, lower=True)
        weights = cho_solve(factor, np.ones(len(self._values)))
        return factor, weights, float(np.sum(weights))

    def _mean(self, weights: Floats, total: float) -> float:
        return float(weights @ self._values) / total


