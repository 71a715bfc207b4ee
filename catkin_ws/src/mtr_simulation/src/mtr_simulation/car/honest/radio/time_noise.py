"""Noise in time: variation of the gain at the same place, in dB.

It is an Ornstein-Uhlenbeck process: normally distributed with a constant sigma, correlated by exp(-dt / T).

    n(t + dt) = r n(t) + sqrt(1 - r^2) g,   r = exp(-dt / T),  g normally distributed

Sigma is 1 to 3 dB for a link between objects at rest, with people and cars passing (Hashemi 1993, Proc. IEEE 81, 5.D).
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import Optional

from ...noise import gaussian


class TimeNoise:
    """Noise that follows the time in steps; its value depends only on seed and steps.

    Attributes:
        now_db: current value.
    """

    def __init__(self, seed: int, sigma_db: float, correlation_s: float):
        self._seed = seed
        self._sigma_db = sigma_db
        self._correlation_s = correlation_s
        self._time_ns: Optional[int] = None
        self._number = 0
        self._unit = gaussian(seed, "time_noise", 0)

    @property
    def now_db(self) -> float:
        """Current value in dB."""
        return self._sigma_db * self._unit

    def step(self, time_ns: int) -> None:
        """Advance to a time."""
        if self._time_ns is not None and time_ns > self._time_ns:
            self._number += 1
            kept = correlation(time_ns - self._time_ns, self._correlation_s)
            fresh = gaussian(self._seed, "time_noise", self._number)
            self._unit = kept * self._unit + math.sqrt(1.0 - kept * kept) * fresh
        self._time_ns = time_ns


@functools.lru_cache(maxsize=16)
def correlation(interval_ns: int, correlation_s: float) -> float:
    """Return the correlation of two values with this time difference."""
    return math.exp(-interval_ns * 1e-9 / correlation_s)
