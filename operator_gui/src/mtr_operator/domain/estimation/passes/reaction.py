"""How far beyond the static boundary a moving key is when the Car reacts.

The key moves by v * poll_s from poll to poll, the first of which finds it at an even random depth (the phase). The
chain of polls that agree gives the probability of each depth; the instant that the bus tells is uncertain by its
cycle, even within +- v * cycle_s / 2, and the place of the key by a normal of sigma_m:

    P(depth) = sum over phase, poll k of  P(k-th poll is the debounce-th in a row)  U(v cycle_s) * N(sigma_m)
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.special import ndtr

from ..interval import FloatArray
from .timing import TIMINGS, CarTiming

_PHASES = 24
# Depths of which a table tells, in steps of 2 mm.
STEP_M = 0.002
MIN_DEPTH_M, MAX_DEPTH_M = -0.6, 2.4
# Beyond this many sigmas a poll does what the sign of the depth says.
_CERTAIN_SIGMAS = 4.0
# A pass that no timing explains (the Car was disturbed) leaves all places alike.
_OUTLIER = 1e-4


def depths() -> FloatArray:
    """Middles of the table's bins."""
    return np.arange(MIN_DEPTH_M, MAX_DEPTH_M, STEP_M) + STEP_M / 2.0


def reaction_table(speed_mps: float, cycle_s: float, sigma_m: float) -> FloatArray:
    """Density of the depth, in 1/m; axes [timing, depth]."""
    return np.stack([_told(_polled(timing, speed_mps), speed_mps * cycle_s, sigma_m) for timing in TIMINGS])


def _polled(timing: CarTiming, speed_mps: float) -> FloatArray:
    """Probability of each bin of depth at the poll that decides."""
    step_m = speed_mps * timing.poll_s
    start_m = -_CERTAIN_SIGMAS * timing.noise_m
    polls = math.ceil((2.0 * _CERTAIN_SIGMAS * timing.noise_m) / step_m) + timing.debounce + 1
    depth_m = start_m + (np.arange(polls)[:, None] + (np.arange(_PHASES) + 0.5) / _PHASES) * step_m
    notices = ndtr(depth_m / timing.noise_m)
    agreeing = np.zeros((timing.debounce, _PHASES))
    agreeing[0] = 1.0
    decided = np.zeros_like(depth_m)
    for number, notice in enumerate(notices):
        decided[number] = agreeing[-1] * notice
        missed = np.sum(agreeing, axis=0) * (1.0 - notice)
        agreeing = np.concatenate((missed[None], agreeing[:-1] * notice))
    # A phase stands for its part of the way between polls.
    return _spread(depth_m.ravel(), decided.ravel() / _PHASES, step_m / _PHASES)


def _spread(depth_m: FloatArray, weights: FloatArray, width_m: float) -> FloatArray:
    """Bins of evenly wide pieces."""
    edges = np.append(depths() - STEP_M / 2.0, MAX_DEPTH_M)
    order = np.argsort(depth_m)
    starts, ends = depth_m[order] - width_m / 2.0, depth_m[order] + width_m / 2.0
    borders = np.concatenate((starts, ends[-1:]))
    below = np.concatenate(([0.0], np.cumsum(weights[order])))
    return np.diff(np.interp(edges, borders, below))


def _told(polled: FloatArray, cycle_m: float, sigma_m: float) -> FloatArray:
    """With the bus' cycle and the place's error; a density."""
    bins = max(1, round(cycle_m / STEP_M) | 1)
    even = np.convolve(polled, np.full(bins, 1.0 / bins), mode="same")
    blurred = gaussian_filter1d(even, sigma_m / STEP_M, mode="constant")
    return np.asarray(blurred / STEP_M + _OUTLIER)
