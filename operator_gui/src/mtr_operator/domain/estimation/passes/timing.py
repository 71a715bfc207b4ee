"""Hypotheses on a Car's passive entry: poll period, number of agreeing polls, and delay.

A Car polls the key every poll_s and reacts when `debounce` polls in a row agree. A poll detects the key with
probability Phi(depth / noise_m), where depth is the key's distance beyond the static boundary, at which half of the
polls detect a stationary key. The delay from the poll to the time on the bus is delay_s.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..interval import FloatArray

# Polls of real cars come every 100 to 700 ms; faster ones are practically continuous.
POLLS_S = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.36, 0.43, 0.5, 0.6, 0.7, 0.85)
DEBOUNCES = (1, 2, 3)
# Effect of 0.1 to 1 dB of noise in time at 60 dB per decade and 1.5 m; inductive low-frequency fields hardly fade.
NOISES_M, NOISE_PRIOR = (0.005, 0.012, 0.03, 0.07, 0.15, 0.3), (0.25, 0.25, 0.2, 0.15, 0.1, 0.05)
# Motors of locks and their control units need up to some tenths of a second. One Car in twenty has an additional timer,
# of any length up to half a minute.
USUAL_DELAY_S, TIMER_SHARE, LONGEST_TIMER_S = 0.4, 0.05, 30.0
# A longer timer restarts while polls still disagree.
_RESTARTED_FROM_S = 1.0
# Longest duration of polls, and longest reaction without a timer.
MAX_POLLED_S = max(POLLS_S) * max(DEBOUNCES)
MAX_REACTION_S = MAX_POLLED_S + USUAL_DELAY_S


@dataclass(frozen=True)
class CarTiming:
    """One hypothesis on the timing."""

    poll_s: float
    debounce: int
    noise_m: float

    @property
    def polled_s(self) -> float:
        """Mean time from the boundary to the deciding poll, without noise."""
        return self.poll_s * (self.debounce - 0.5)


# All hypotheses, and their prior probabilities, which depend on the noise.
TIMINGS = tuple(CarTiming(*each) for each in itertools.product(POLLS_S, DEBOUNCES, NOISES_M))
PRIOR = tuple(NOISE_PRIOR[NOISES_M.index(timing.noise_m)] for timing in TIMINGS)


def prior_of(reactions_s: FloatArray) -> FloatArray:
    """Return the prior probability of each timing with each mean reaction time; axes [timing, reaction].

    The delay is the reaction time less the polls; the logarithm of a timer's delay is uniform.
    """
    delays_s = _delays(reactions_s)
    usual = (1.0 - TIMER_SHARE) / USUAL_DELAY_S * ((delays_s >= 0.0) & (delays_s <= USUAL_DELAY_S))
    is_timer = (delays_s > USUAL_DELAY_S) & (delays_s <= LONGEST_TIMER_S)
    timer = TIMER_SHARE / np.log(LONGEST_TIMER_S / USUAL_DELAY_S) / np.maximum(delays_s, USUAL_DELAY_S)
    return np.asarray(np.array(PRIOR)[:, None] * (usual + timer * is_timer))


def has_timer(reactions_s: FloatArray) -> npt.NDArray[np.bool_]:
    """Return True for delays of timers that restart when the key is detected in between; axes as in prior_of."""
    return np.asarray(_delays(reactions_s) > _RESTARTED_FROM_S)


def _delays(reactions_s: FloatArray) -> FloatArray:
    return np.asarray(reactions_s - np.array([timing.polled_s for timing in TIMINGS])[:, None])
