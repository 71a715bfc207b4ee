"""Depth of a moving key beyond the static boundary when the Car reacts.

The key moves by v * poll_s from poll to poll; its depth at the first poll is uniformly random (the phase). The chain of
agreeing polls gives the probability of each depth. The time on the bus is uncertain by its cycle, uniform within +- v *
cycle_s / 2, and the position of the key is normal with sigma_m:

    P(depth) = sum over phase, poll k of  P(k-th poll is the debounce-th in a row)  U(v cycle_s) * N(sigma_m)

Depths are relative to v times the mean duration of the polls without noise, so that all timings are compared at the
same reaction time.

A timer starts when enough polls agree that the key has left, and restarts if they have detected it in between. The last
departure counts:

    P(k-th poll is the last departure) = P(it is a departure)  P(no `debounce` polls in a row find the key after it).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.special import ndtr

from ..interval import FloatArray
from .timing import DEBOUNCES, NOISES_M, POLLS_S

_PHASES = 24
# Depths of a table, in steps of 2 mm.
STEP_M = 0.002
MIN_DEPTH_M, MAX_DEPTH_M = -1.2, 2.8
# Beyond this many sigmas the result of a poll is certain.
_CERTAIN_SIGMAS = 4.0
# A pass that fits no timing (the Car was disturbed) gives all positions the same likelihood.
OUTLIER = 1e-4


def depths() -> FloatArray:
    """Return the centres of the table's bins."""
    return np.arange(MIN_DEPTH_M, MAX_DEPTH_M, STEP_M) + STEP_M / 2.0


def reaction_table(speed_mps: float, cycle_s: float, sigma_m: float, has_timer: bool = False) -> FloatArray:
    """Return the density of the depth beyond the mean reaction time, in 1/m; axes [timing, depth]."""
    return np.stack([_told(row, speed_mps * cycle_s, sigma_m) for poll_s, debounce in itertools.product(
        POLLS_S, DEBOUNCES) for row in _polled(speed_mps * poll_s, debounce, has_timer)])


def _polled(step_m: float, debounce: int, has_timer: bool) -> list[FloatArray]:
    """Return the probability of each depth bin at the deciding poll, for each noise; step_m: distance between polls."""
    noises_m = np.array(NOISES_M)[:, None]
    polls = math.ceil(2.0 * _CERTAIN_SIGMAS * max(NOISES_M) / step_m) + debounce + 1
    first_m = -_CERTAIN_SIGMAS * max(NOISES_M) + (np.arange(_PHASES) + 0.5) / _PHASES * step_m
    notices = np.stack([ndtr((first_m + number * step_m) / noises_m) for number in range(polls)])
    decided = _last(notices, debounce) if has_timer else _first(notices, debounce)
    depth_m = (first_m + np.arange(polls)[:, None] * step_m).ravel() - (debounce - 0.5) * step_m
    # A phase represents its part of the distance between polls.
    return [_spread(depth_m, decided[:, number].ravel() / _PHASES, step_m / _PHASES)
            for number in range(len(NOISES_M))]


def _first(notices: FloatArray, debounce: int) -> FloatArray:
    """Return the probability, per poll, that `debounce` polls in a row agree for the first time. notices: probability
    of each poll."""
    agreeing = np.zeros((debounce, *notices.shape[1:]))
    agreeing[0] = 1.0
    decided = np.zeros_like(notices)
    for number, notice in enumerate(notices):
        decided[number] = agreeing[-1] * notice
        agreeing = _agree(agreeing, notice, 0.0)
    return decided


def _last(notices: FloatArray, debounce: int) -> FloatArray:
    """Return the probability, per poll, that `debounce` polls in a row agree for the last time, before the same number
    disagrees."""
    near, gone = np.zeros((2, debounce, *notices.shape[1:]))
    near[0] = 1.0
    departures = np.zeros_like(notices)
    for number, notice in enumerate(notices):
        departures[number], returns = near[-1] * notice, gone[-1] * (1.0 - notice)
        near, gone = _agree(near, notice, returns), _agree(gone, 1.0 - notice, departures[number])
    stays = np.ones((debounce, *notices.shape[1:]))
    for number in range(len(notices) - 1, -1, -1):
        departures[number] *= stays[0]
        later = np.concatenate((stays[1:], np.zeros((1, *notices.shape[1:]))))
        stays = notices[number] * stays[0] + (1.0 - notices[number]) * later
    return departures


def _agree(agreeing: FloatArray, notice: FloatArray, arrives: FloatArray | float) -> FloatArray:
    """Return the probability of each number of consecutive agreeing polls, one poll later; arrives: added at zero."""
    missed = np.sum(agreeing, axis=0) * (1.0 - notice) + arrives
    return np.concatenate((missed[None], agreeing[:-1] * notice))


def _spread(depth_m: FloatArray, weights: FloatArray, width_m: float) -> FloatArray:
    """Distribute pieces of equal width to the bins."""
    edges = np.append(depths() - STEP_M / 2.0, MAX_DEPTH_M)
    order = np.argsort(depth_m)
    starts, ends = depth_m[order] - width_m / 2.0, depth_m[order] + width_m / 2.0
    borders = np.concatenate((starts, ends[-1:]))
    below = np.concatenate(([0.0], np.cumsum(weights[order])))
    return np.diff(np.interp(edges, borders, below))


def _told(polled: FloatArray, cycle_m: float, sigma_m: float) -> FloatArray:
    """Return the density including the bus cycle and the error of the position."""
    bins = max(1, round(cycle_m / STEP_M) | 1)
    even = np.convolve(polled, np.full(bins, 1.0 / bins), mode="same")
    blurred = gaussian_filter1d(even, sigma_m / STEP_M, mode="constant")
    return np.asarray(blurred / STEP_M + OUTLIER)
