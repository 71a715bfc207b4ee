"""What the passes of one axis make of each place of the boundary, for each hypothesis on the Car's timing."""
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

# Places at which the boundary may be.
_BINS = 400
# Tables are made for speeds that differ by this; depths in between are scaled, as most of them goes with the speed.
_SPEED_RATIO = 1.06
ALL_TIMINGS = tuple(range(len(TIMINGS)))


@dataclass(frozen=True)
class Pass:
    """One event: the key's distance at it, and its speed. outward: the key went away (lock), else it came (unlock).

    steps: of an approach in steps, whose speed says nothing; None for a key that moves.
    """

    distance_m: float
    speed_mps: float
    outward: bool = False
    steps: Steps | None = None

    @property
    def along_m(self) -> float:
        """Place along the way: it grows outward and inward, so that depth is boundary to event."""
        return self.distance_m if self.outward else -self.distance_m


@dataclass(frozen=True)
class Circumstances:
    """What all passes have in common.

    cycle_s: of the message that tells the state. sigma_m: of the key's place. reactions_s: mean reaction times, evenly
    spaced, that are hypotheses beside the timings.
    """

    cycle_s: float
    sigma_m: float
    reactions_s: tuple[float, ...]


def likelihood_of(passes: tuple[Pass, ...], given: Circumstances,
                  timings: tuple[int, ...] = ALL_TIMINGS) -> tuple[FloatArray, FloatArray]:
    """Places along the way, and the logarithm of what the passes make of each; axes [timing, reaction, boundary]."""
    first_m, last_m = (pick(end) for pick, end in zip((max, min), zip(*(_ends(each, given) for each in passes))))
    boundary_m = np.linspace(first_m, max(last_m, first_m + _BINS * STEP_M), _BINS)
    rows = np.array(timings)
    return boundary_m, np.asarray(sum(_log(each, each.along_m - boundary_m, given, rows) for each in passes))


@functools.lru_cache(maxsize=1024)
def evidence_of(passes: tuple[Pass, ...], given: Circumstances) -> FloatArray:
    """The same with the boundary integrated out; axes [timing, reaction]."""
    boundary_m, log = likelihood_of(passes, given)
    return np.asarray(logsumexp(log, axis=-1) + math.log(boundary_m[1] - boundary_m[0]))


def _ends(each: Pass, given: Circumstances) -> tuple[float, float]:
    """Where the boundary of a pass may be, along the way."""
    way_m = each.speed_mps * (given.reactions_s[-1] + MAX_POLLED_S) if each.steps is None else each.steps.step_m
    return each.along_m - way_m + MIN_DEPTH_M / 4.0, each.along_m - MIN_DEPTH_M


def _log(each: Pass, depth_m: FloatArray, given: Circumstances, timings: FloatArray) -> FloatArray:
    """Axes [timing, reaction, boundary]."""
    reactions_s = np.array(given.reactions_s)[:, None]
    if each.steps is None:
        number = round(math.log(each.speed_mps) / math.log(_SPEED_RATIO))
        bins = _bins((depth_m - each.speed_mps * reactions_s) * (_SPEED_RATIO ** number / each.speed_mps))
        table = _pass_table(number, given.cycle_s, given.sigma_m, False)[timings]
        rows, columns = np.nonzero(has_timer(np.array(given.reactions_s))[timings])
        if not len(rows):
            return np.asarray(table[:, bins])
        # Another table where a timer starts again, looked up there alone: elsewhere it would be half of all work.
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
