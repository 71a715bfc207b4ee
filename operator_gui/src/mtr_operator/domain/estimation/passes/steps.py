"""Approach in steps: the key stops after each step for the Car's reaction time, and the Car reacts at one of the stops.

A reaction at a depth, but not at the previous stops, locates the boundary approximately within the last step, at any
poll period:

    P(depth) = q(depth) * product over k of (1 - q(depth - k * step)),

q is the probability that `debounce` consecutive polls of one stop agree.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.special import ndtr

from ..interval import FloatArray
from .reaction import MAX_DEPTH_M, MIN_DEPTH_M, OUTLIER, STEP_M, depths
from .timing import TIMINGS, CarTiming


@dataclass(frozen=True)
class Steps:
    """Stops of an approach. step_m: distance between stops, each of which lasts stand_s."""

    step_m: float
    stand_s: float


def steps_table(steps: Steps, sigma_m: float) -> FloatArray:
    """Return the density of the depth, in 1/m; axes [timing, depth]."""
    return np.stack([_decided(steps, timing, sigma_m) for timing in TIMINGS])


def _decided(steps: Steps, timing: CarTiming, sigma_m: float) -> FloatArray:
    depth_m = depths()
    shift = max(1, round(steps.step_m / STEP_M))
    reacts = _reacts(ndtr(depth_m / timing.noise_m), steps.stand_s / timing.poll_s, timing.debounce)
    before = np.ones_like(reacts)
    for number in range(1, math.ceil((MAX_DEPTH_M - MIN_DEPTH_M) / STEP_M / shift)):
        before[number * shift:] *= 1.0 - reacts[:-number * shift]
    density = reacts * before / steps.step_m
    return np.asarray(gaussian_filter1d(density, sigma_m / STEP_M, mode="constant") + OUTLIER)


def _reacts(notices: FloatArray, polls: float, debounce: int) -> FloatArray:
    """Return the probability that enough consecutive polls of a stop agree; the fractional rest is the probability of
    one more poll."""
    whole = math.floor(polls)
    agreeing, done = np.zeros((debounce, len(notices))), [np.zeros_like(notices)]
    agreeing[0] = 1.0
    for _ in range(whole + 1):
        done.append(done[-1] + agreeing[-1] * notices)
        missed = np.sum(agreeing, axis=0) * (1.0 - notices)
        agreeing = np.concatenate((missed[None], agreeing[:-1] * notices))
    return np.asarray(done[whole] + (polls - whole) * (done[whole + 1] - done[whole]))
