"""Likelihood of the boundary from the passes of one axis, for each hypothesis on the Car's timing."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from ..interval import FloatArray
from .reaction import MIN_DEPTH_M, STEP_M, depths, reaction_table
from .steps import Steps, steps_table
from .timing import MAX_POLLED_S, TIMINGS, has_timer

# Number of possible positions of the boundary.
_BINS = 400
# Ratio of the speeds for which tables are computed; depths in between are scaled, because they are mainly proportional
# to the speed.
_SPEED_RATIO = 1.06
ALL_TIMINGS = tuple(range(len(TIMINGS)))


@dataclass(frozen=True)
class Pass:
    """One event: distance and speed of the key. outward: the key moved away (lock), else it approached (unlock).

    steps: of an approach in steps, for which the speed is ignored; None for a moving key.
    """

    distance_m: float
    speed_mps: float
    outward: bool = False
    steps: Steps | None = None

    @property
    def along_m(self) -> float:
        """Position along the path: it increases both outward and inward, so that depth is from boundary to event."""
        return self.distance_m if self.outward else -self.distance_m


@dataclass(frozen=True)
class Circumstances:
    """Common properties of all passes.

    cycle_s: of the message of the state. sigma_m: of the key's position. reactions_s: mean reaction times, evenly
    spaced, that are hypotheses in addition to the timings.
    """

    cycle_s: float
    sigma_m: float
    reactions_s: tuple[float, ...]


def likelihood_of(passes: tuple[Pass, ...], given: Circumstances,
                  timings: tuple[int, ...] = ALL_TIMINGS) -> tuple[FloatArray, FloatArray]:
    """Return positions along the path, and the log likelihood of each; axes [timing, reaction, boundary]."""
    first_m, last_m = (pick(end) for pick, end in zip((max, min), zip(*(_ends(each, given) for each in passes))))
    boundary_m = np.linspace(first_m, max(last_m, first_m + _BINS * STEP_M), _BINS)
    rows = np.array(timings)
    return boundary_m, np.asarray(sum(_log(each, each.along_m - boundary_m, given, rows) for each in passes))


@functools.lru_cache(maxsize=1024)
def evidence_of(passes: tuple[Pass, ...], given: Circumstances) -> FloatArray:
    """Return the log likelihood with the boundary integrated out; axes [timing, reaction]."""
    boundary_m, log = likelihood_of(passes, given)
    return np.asarray(logsumexp(log, axis=-1) + math.log(boundary_m[1] - boundary_m[0]))


def _ends(each: Pass, given: Circumstances) -> tuple[float, float]:
    """Return the possible range of a pass' boundary along the path."""
    way_m = each.speed_mps * (given.reactions_s[-1] + MAX_POLLED_S) if each.steps is None else each.steps.step_m
    return each.along_m - way_m + MIN_DEPTH_M / 4.0, each.along_m - MIN_DEPTH_M


def _log(each: Pass, depth_m: FloatArray, given: Circumstances, timings: FloatArray) -> FloatArray:
    """Return the log likelihood of a pass; axes [timing, reaction, boundary]."""
    reactions_s = np.array(given.reactions_s)[:, None]
    if each.steps is None:
        number = round(math.log(each.speed_mps) / math.log(_SPEED_RATIO))
        bins = _bins((depth_m - each.speed_mps * reactions_s) * (_SPEED_RATIO ** number / each.speed_mps))
        table = _pass_table(number, given.cycle_s, given.sigma_m, False)[timings]
        rows, columns = np.nonzero(has_timer(np.array(given.reactions_s))[timings])
        if not len(rows):
            return np.asarray(table[:, bins])
        # A timer that restarts needs a different table. Only these entries are looked up, because all of them would
        # double the time.
        found, again = table.take(bins, axis=1), _pass_table(number, given.cycle_s, given.sigma_m, True)
        found[rows, columns] = again[timings[rows][:, None], bins[columns]]
        return np.asarray(found)
    return np.asarray(_steps_table(each.steps, given.sigma_m)[timings][:, _bins(depth_m - np.zeros_like(reactions_s))])


def _bins(depth_m: FloatArray) -> FloatArray:
    return np.asarray(np.clip(np.round((depth_m - depths()[0]) / STEP_M).astype(int), 0, len(depths()) - 1))


@functools.lru_cache(maxsize=64)
def _pass_table(number: int, cycle_s: float, sigma_m: float, is_timer: bool) -> FloatArray:
    return np.log(reaction_table(_SPEED_RATIO ** number, cycle_s, sigma_m, is_timer)).astype(np.float32)


@functools.lru_cache(maxsize=8)
def _steps_table(steps: Steps, sigma_m: float) -> FloatArray:
    return np.log(steps_table(steps, sigma_m)).astype(np.float32)
