"""The static boundary of each axis and the Car's reaction time, from passes at known speeds.

A pass at speed v reacts at depth beyond the boundary: the boundary is its intercept at speed zero, the reaction time
its slope. Polls, debounce, noise and delay belong to the Car: each axis' own evidence for them is its likelihood with
the boundary integrated out, and the prior of one axis is the product of the others' evidence, as for the radials of
Key press.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ..interval import UNKNOWN, FloatArray, Interval, interval_of
from .delay import base_delay
from .likelihood import Circumstances, Pass, evidence_of, likelihood_of
from .timing import DELAYS_S, MAX_REACTION_S, PRIOR, TIMINGS

__all__ = ["NO_BOUNDARY", "Boundary", "BoundaryCampaign", "Pass"]

@dataclass(frozen=True)
class Boundary:
    """What passes say of an axis."""

    static: Interval
    reaction_s: Interval


NO_BOUNDARY = Boundary(UNKNOWN, UNKNOWN)


class BoundaryCampaign:
    """Axes of one Car; cycle_s: of the message that tells the state, sigma_m: of the key's place from pass to pass."""

    def __init__(self, cycle_s: float, sigma_m: float = 0.003):
        self._cycle_s = cycle_s
        self._sigma_m = sigma_m
        self._passes: dict[int, tuple[Pass, ...]] = {}

    def keep(self, axis: int, passes: Sequence[Pass]) -> None:
        """Take or replace all passes of an axis in one direction."""
        self._passes[axis] = tuple(passes)

    def boundary(self, axis: int) -> Boundary:
        """With what the other axes say of the Car; NO_BOUNDARY for an axis without passes."""
        if not self._passes.get(axis):
            return NO_BOUNDARY
        base_s = base_delay([[(each.along_m, each.speed_mps) for each in passes if each.steps is None]
                             for passes in self._passes.values()])
        given = Circumstances(self._cycle_s, self._sigma_m, base_s)
        others = [evidence_of(passes, given) for number, passes in self._passes.items() if passes and number != axis]
        prior = np.log(PRIOR)[:, None] + sum(others)
        boundary_m, log = likelihood_of(self._passes[axis], given)
        total = log + prior[..., None]
        weights = np.exp(total - np.max(total))
        half_m = (boundary_m[1] - boundary_m[0]) / 2.0
        places_m, counts = boundary_m, np.sum(weights, axis=(0, 1))
        if not self._passes[axis][0].outward:
            places_m, counts = -boundary_m[::-1], counts[::-1]
        return Boundary(interval_of(np.append(places_m - half_m, places_m[-1] + half_m), counts),
                        _reaction(np.sum(weights, axis=2), base_s))


def _reaction(weights: FloatArray, base_s: float) -> Interval:
    """Mean reaction time of each hypothesis, weighted; axes of the weights [timing, delay]."""
    times_s = np.array([[timing.poll_s * (timing.debounce - 0.5) + base_s + delay_s for delay_s in DELAYS_S]
                        for timing in TIMINGS])
    edges_s = np.arange(0.0, base_s + MAX_REACTION_S + 0.4, 0.01)
    counts, _ = np.histogram(times_s, edges_s, weights=weights)
    return interval_of(edges_s, counts.astype(float))
