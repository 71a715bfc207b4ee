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
from scipy.special import logsumexp

from ..interval import FloatArray, Interval, interval_of
from .reaction import STEP_M, depths, reaction_table
from .timing import DELAYS_S, PRIOR, TIMINGS

# How far from the event the boundary is looked for, in steps of the table.
_BINS = 400
# Speeds are told apart by this; tables are made once for each.
_SPEED_STEP_MPS = 0.005


@dataclass(frozen=True)
class Pass:
    """One event: the key's distance at it, and its speed. outward: the key went away (lock), else it came (unlock)."""

    distance_m: float
    speed_mps: float
    outward: bool = False


@dataclass(frozen=True)
class Boundary:
    """What passes say of an axis."""

    static: Interval
    reaction_s: Interval


class BoundaryCampaign:
    """Axes of one Car; cycle_s: of the message that tells the state, sigma_m: of the key's place."""

    def __init__(self, cycle_s: float, sigma_m: float = 0.003):
        self._cycle_s = cycle_s
        self._sigma_m = sigma_m
        self._tables: dict[int, FloatArray] = {}
        self._axes: dict[int, tuple[FloatArray, FloatArray]] = {}
        self._evidence: dict[int, FloatArray] = {}

    def keep(self, axis: int, passes: Sequence[Pass]) -> None:
        """Take or replace all passes of an axis in one direction."""
        # Along the way: outward counts as it is, inward with its sign turned, so that depth is boundary to event.
        along_m = np.array([each.distance_m if each.outward else -each.distance_m for each in passes])
        slowest = min(range(len(passes)), key=lambda number: passes[number].speed_mps)
        boundary_m = along_m[slowest] + STEP_M * (np.arange(_BINS) - 0.75 * _BINS)
        log = sum(self._log(each.speed_mps, place_m - boundary_m) for each, place_m in zip(passes, along_m))
        signed_m = boundary_m if passes[0].outward else -boundary_m
        self._axes[axis] = signed_m, np.asarray(log)
        self._evidence[axis] = np.asarray(logsumexp(log, axis=-1))

    def boundary(self, axis: int) -> Boundary:
        """With what the other axes say of the Car."""
        others = [evidence for number, evidence in self._evidence.items() if number != axis]
        prior = np.log(PRIOR)[:, None] + sum(others)
        boundary_m, log = self._axes[axis]
        total = log + prior[..., None]
        weights = np.exp(total - np.max(total))
        order = np.argsort(boundary_m)
        edges_m = np.append(boundary_m[order] - STEP_M / 2.0, boundary_m[order][-1] + STEP_M / 2.0)
        return Boundary(interval_of(edges_m, np.sum(weights, axis=(0, 1))[order]),
                        self._reaction(np.sum(weights, axis=2)))

    def _log(self, speed_mps: float, depth_m: FloatArray) -> FloatArray:
        """Axes [timing, delay, boundary]."""
        key = max(1, round(speed_mps / _SPEED_STEP_MPS))
        if key not in self._tables:
            self._tables[key] = reaction_table(key * _SPEED_STEP_MPS, self._cycle_s, self._sigma_m)
        table, first_m = self._tables[key], depths()[0]
        late_m = depth_m - speed_mps * np.array(DELAYS_S)[:, None]
        bins = np.clip(np.round((late_m - first_m) / STEP_M).astype(int), 0, table.shape[1] - 1)
        return np.asarray(np.log(table[:, bins]))

    @staticmethod
    def _reaction(weights: FloatArray) -> Interval:
        """Mean reaction time of each hypothesis, weighted; axes of the weights [timing, delay]."""
        times_s = np.array([[timing.poll_s * (timing.debounce - 0.5) + delay_s for delay_s in DELAYS_S]
                            for timing in TIMINGS])
        edges_s = np.arange(0.0, 3.2, 0.01)
        counts, _ = np.histogram(times_s, edges_s, weights=weights)
        return interval_of(edges_s, counts.astype(float))
