"""Which runs a plan asks for: all combinations, a Latin hypercube, or the samples that Sobol indices need."""
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
    """All combinations; the last factor varies fastest."""
    values = [factor.values for factor in factors.values() if isinstance(factor, Values)]
    yield from (dict(zip(factors, each)) for each in itertools.product(*values))


def grid_size(factors: Mapping[str, Factor]) -> int:
    """Without making them; CampaignError for a factor that has no values to combine."""
    for name, factor in factors.items():
        if not isinstance(factor, Values):
            raise CampaignError(f"{name:.60} is a range, of which a grid cannot take all values; list some, or choose "
                                "the design latin_hypercube.")
    return math.prod(len(factor.values) for factor in factors.values() if isinstance(factor, Values))


def latin_hypercube(factors: Mapping[str, Factor], runs: int, seed: int) -> Iterator[Settings]:
    """Each part of each factor's range once."""
    from scipy.stats import qmc
    yield from _at(factors, qmc.LatinHypercube(len(factors), seed=seed).random(runs))


def sobol(factors: Mapping[str, Factor], samples: int, seed: int) -> Iterator[Settings]:
    """Saltelli's samples for Sobol indices of first and total order."""
    from SALib.sample import sobol as sampler
    # SALib asks for a power of two, and tells so in a warning; the plan has been checked for it.
    yield from _at(factors, sampler.sample(problem_of(factors), samples, calc_second_order=False, seed=seed))


def sobol_size(factors: Mapping[str, Factor], samples: int) -> int:
    """So many runs."""
    return samples * (len(factors) + 2)


def problem_of(factors: Mapping[str, Factor]) -> dict[str, Any]:
    """The factors as SALib takes them: parts of the whole, which each factor turns into its own values."""
    return {"num_vars": len(factors), "names": list(factors), "bounds": [[0.0, 1.0]] * len(factors)}


def _at(factors: Mapping[str, Factor], parts: Sequence[Sequence[float]]) -> Iterator[Settings]:
    for row in parts:
        yield {name: factor.at(float(part)) for (name, factor), part in zip(factors.items(), row)}
