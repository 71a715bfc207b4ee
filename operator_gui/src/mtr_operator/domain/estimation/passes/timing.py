"""What a Car's passive entry may be like: how often it polls, how often polls have to agree, how late it tells.

A Car asks for the key every poll_s and reacts when `debounce` polls in a row agree; a poll notices the key with
probability Phi(depth / noise_m), where depth is how far the key is beyond the static boundary, the place at which
half of the polls notice a standing key. The rest, from the poll to the instant that the bus tells, takes delay_s.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
from dataclasses import dataclass

# Polls of real cars come every 100 to 700 ms; faster ones are as good as continuous.
POLLS_S = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.36, 0.43, 0.5, 0.6, 0.7, 0.85)
DEBOUNCES = (1, 2, 3)
# Of 0.1 to 1 dB of noise in time at 60 dB a decade and 1.5 m; inductive fields of low frequency hardly fade.
NOISES_M, NOISE_PRIOR = (0.005, 0.012, 0.03, 0.07, 0.15, 0.3), (0.25, 0.25, 0.2, 0.15, 0.1, 0.05)
DELAYS_S = tuple(0.04 * number for number in range(11))
# Longest reaction that polls, debounce and these delays explain.
MAX_REACTION_S = max(POLLS_S) * max(DEBOUNCES) + max(DELAYS_S)


@dataclass(frozen=True)
class CarTiming:
    """One hypothesis."""

    poll_s: float
    debounce: int
    noise_m: float


# All hypotheses, and how likely each is before anything is measured, by its noise.
TIMINGS = tuple(CarTiming(*each) for each in itertools.product(POLLS_S, DEBOUNCES, NOISES_M))
PRIOR = tuple(NOISE_PRIOR[NOISES_M.index(timing.noise_m)] for timing in TIMINGS)
