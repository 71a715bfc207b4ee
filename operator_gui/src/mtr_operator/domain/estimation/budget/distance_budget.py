"""Uncertainty budget of one distance, and the correlation of several.

First order (GUM 5.1 and 5.2), by the package uncertainties: d = d0 + sum of sensitivity * error, where a common term is
the same variable on every line. Degrees of freedom by Welch and Satterthwaite (GUM G.4), coverage factor by Student's
t.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

import uncertainties

from ..student import quantile
from .terms import Term


@dataclass(frozen=True)
class DistanceBudget:
    """Budget of one distance of one line.

    Attributes:
        line: its number. word: name of the distance.
        terms: all parts of the uncertainty.
    """

    line: int
    word: str
    distance_m: float
    terms: tuple[Term, ...]

    @property
    def sigma_m(self) -> float:
        """Combined standard uncertainty."""
        return math.hypot(self.own_sigma_m, self.common_sigma_m)

    @property
    def own_sigma_m(self) -> float:
        """Standard uncertainty from errors of this line alone."""
        return math.hypot(*(term.contribution_m for term in self.terms if not term.is_common))

    @property
    def common_sigma_m(self) -> float:
        """Standard uncertainty from errors that other lines share."""
        return math.hypot(*(term.contribution_m for term in self.terms if term.is_common))

    @property
    def degrees_of_freedom(self) -> float:
        """Effective degrees of freedom; infinite if every term's are."""
        share = sum(term.contribution_m ** 4 / term.degrees_of_freedom for term in self.terms)
        return self.sigma_m ** 4 / share if share > 0.0 else math.inf

    @property
    def coverage_factor(self) -> float:
        """Factor of sigma_m for 95 % coverage."""
        return quantile(self.degrees_of_freedom)

    @property
    def expanded_m(self) -> float:
        """Expanded uncertainty: half the width of the interval with 95 % coverage."""
        return self.coverage_factor * self.sigma_m


def correlations(budgets: Sequence[DistanceBudget]) -> list[list[float]]:
    """Return the correlation coefficients of the distances' errors, in their order; 1 on the diagonal."""
    common: dict[str, Any] = {}
    numbers = [_number(budget, common) for budget in budgets]
    if not numbers:
        return []
    return [[float(value) for value in row] for row in uncertainties.correlation_matrix(numbers)]


def _number(budget: DistanceBudget, common: dict[str, Any]) -> Any:
    """Return the distance as a number with its errors; common: variables of shared errors, by name."""
    # The package warns of a number with zero error; an unknown error, NaN, must remain.
    terms = [term for term in budget.terms if term.sigma != 0.0]
    number: Any = budget.distance_m if terms else uncertainties.ufloat(budget.distance_m, 0.0)
    for term in terms:
        error = uncertainties.ufloat(0.0, term.sigma)
        if term.is_common:
            error = common.setdefault(term.name, error)
        number = number + term.sensitivity * error
    return number
