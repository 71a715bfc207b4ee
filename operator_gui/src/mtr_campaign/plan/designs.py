"""Designs of experiments: full factorial grid, Latin hypercube, and samples for Sobol indices."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math
from typing import Any, Iterator, Mapping, Sequence

from ..errors import CampaignError
from .factors import Factor, Values
from .run import Value

Settings = dict[str, Value]


def grid(factors: Mapping[str, Factor]) -> Iterator[Settings]:
    """Yield all combinations; the last factor varies fastest."""
    values = [factor.values for factor in factors.values() if isinstance(factor, Values)]
    yield from (dict(zip(factors, each)) for each in itertools.product(*values))


def grid_size(factors: Mapping[str, Factor]) -> int:
    """Return the number of combinations; CampaignError for a factor without discrete values."""
    for name, factor in factors.items():
        if not isinstance(factor, Values):
            raise CampaignError(f"{name:.60} is a range, of which a grid cannot take all values; list some, or choose "
                                "the design latin_hypercube.")
    return math.prod(len(factor.values) for factor in factors.values() if isinstance(factor, Values))


def latin_hypercube(factors: Mapping[str, Factor], runs: int, seed: int) -> Iterator[Settings]:
    """Yield the samples of a Latin hypercube: each part of each factor's range once."""
    from scipy.stats import qmc
    yield from _at(factors, qmc.LatinHypercube(len(factors), seed=seed).random(runs))


def sobol(factors: Mapping[str, Factor], samples: int, seed: int) -> Iterator[Settings]:
    """Yield Saltelli's samples for Sobol indices of first and total order."""
    from SALib.sample import sobol as sampler
    # SALib requires a power of two and only warns otherwise; the plan has been validated.
    yield from _at(factors, sampler.sample(problem_of(factors), samples, calc_second_order=False, seed=seed))


def sobol_size(factors: Mapping[str, Factor], samples: int) -> int:
    """Return the number of runs."""
    return samples * (len(factors) + 2)


def problem_of(factors: Mapping[str, Factor]) -> dict[str, Any]:
    """Return the factors in SALib's format, as quantiles from 0 to 1, which each factor converts to its own values."""
    return {"num_vars": len(factors), "names": list(factors), "bounds": [[0.0, 1.0]] * len(factors)}


def _at(factors: Mapping[str, Factor], parts: Sequence[Sequence[float]]) -> Iterator[Settings]:
    for row in parts:
        yield {name: factor.at(float(part)) for (name, factor), part in zip(factors.items(), row)}
