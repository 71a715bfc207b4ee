"""Static boundary of each axis and the Car's reaction time, from passes at known speeds.

A pass at speed v reacts at a depth beyond the boundary: the boundary is its intercept at speed zero, the reaction time
its slope. Polls, debounce, noise and delay belong to the Car. The evidence of an axis for them is its likelihood with
the boundary integrated out; the prior of one axis is the product of the others' evidence, as for the radials of Key
press.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Sequence

import numpy as np
from scipy.special import ndtr

from ..interval import SIGMAS_OF_LEVEL, UNKNOWN, FloatArray, Interval, interval_of
from .delay import reaction_times
from .likelihood import Circumstances, Pass, evidence_of, likelihood_of
from .parts import parts_of
from .timing import prior_of

__all__ = ["NO_BOUNDARY", "Boundary", "BoundaryCampaign", "Pass"]

# Log likelihood relative to the best timing below which a timing is ignored.
_UNLIKELY = -14.0


@dataclass(frozen=True)
class Boundary:
    """Estimate of an axis.

    common_m: part of static.sigma_m, in squares, that all axes have in common: the Car's timing. look: static with an
    interval of the requested number of sigmas.
    """

    static: Interval
    reaction_s: Interval
    common_m: float
    look: Interval = UNKNOWN


NO_BOUNDARY = Boundary(UNKNOWN, UNKNOWN, math.nan)


class BoundaryCampaign:
    """Axes of one Car; cycle_s: of the message of the state, sigma_m: of the key's position from pass to pass."""

    def __init__(self, cycle_s: float, sigma_m: float = 0.003):
        self._cycle_s = cycle_s
        self._sigma_m = sigma_m
        self._passes: dict[int, tuple[Pass, ...]] = {}

    def keep(self, axis: int, passes: Sequence[Pass]) -> None:
        """Add or replace all passes of an axis in one direction."""
        self._passes[axis] = tuple(passes)

    def boundary(self, axis: int, sigmas: float = SIGMAS_OF_LEVEL) -> Boundary:
        """Return the boundary, using the other axes' evidence on the Car; NO_BOUNDARY for an axis without passes."""
        if not self._passes.get(axis):
            return NO_BOUNDARY
        given = self._given()
        with np.errstate(divide="ignore"):
            prior = np.log(prior_of(np.array(given.reactions_s)))
        evidence = [evidence_of(passes, given) for passes in self._passes.values() if passes]
        timing = prior + sum(evidence)
        likely = np.nonzero(np.max(timing, axis=1) > np.max(timing) + _UNLIKELY)[0]
        others = timing - evidence_of(self._passes[axis], given)
        boundary_m, log = likelihood_of(self._passes[axis], given, tuple(int(row) for row in likely))
        total = log + others[likely, :, None]
        weights = np.exp(total - np.max(total))
        common_m, shared_m = parts_of(boundary_m, weights, [each[likely] for each in evidence])
        edges_m, counts = self._static(axis, boundary_m, np.sum(weights, axis=(0, 1)))
        return Boundary(replace(interval_of(edges_m, counts), shared_m=shared_m),
                        _reaction(given.reactions_s, np.sum(weights, axis=(0, 2))), common_m,
                        interval_of(edges_m, counts, 1.0 - 2.0 * float(ndtr(-sigmas))))

    def _given(self) -> Circumstances:
        reactions_s = reaction_times([[(each.along_m, each.speed_mps) for each in passes if each.steps is None]
                                      for passes in self._passes.values()])
        return Circumstances(self._cycle_s, self._sigma_m, reactions_s)

    def _static(self, axis: int, places_m: FloatArray, counts: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the histogram of the boundary: edges in m, and the weights between them."""
        half_m = (places_m[1] - places_m[0]) / 2.0
        if not self._passes[axis][0].outward:
            places_m, counts = -places_m[::-1], counts[::-1]
        return np.append(places_m - half_m, places_m[-1] + half_m), counts


def _reaction(reactions_s: Sequence[float], weights: FloatArray) -> Interval:
    """Return the interval of the mean reaction time; each hypothesis represents half a step on both sides."""
    half_s = (reactions_s[1] - reactions_s[0]) / 2.0
    return interval_of(np.append(np.array(reactions_s) - half_s, reactions_s[-1] + half_s), weights)
