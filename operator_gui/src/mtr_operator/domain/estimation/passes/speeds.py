"""How fast the key may pass so that the budget asked for holds.

While the Car polls and its bus tells, the key moves: the two phases are even and independent, so one pass reads the
boundary with a sigma of

    v * sqrt((poll_s^2 + cycle_s^2) / 12),

beside the mean reaction time v * tau, which passes at two speeds take out. Of two passes alone, without other axes
that tell tau, the intercept has sigma  sqrt(2) v1 v2 / |v2 - v1| * sqrt((poll_s^2 + cycle_s^2) / 12).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math


def pass_sigma(speed_mps: float, poll_s: float, cycle_s: float) -> float:
    """Sigma of one pass, in m."""
    return speed_mps * math.sqrt((poll_s ** 2 + cycle_s ** 2) / 12.0)


def proposed_speed(sigma_m: float, poll_s: float, cycle_s: float) -> float:
    """Speed at which one pass has the sigma wanted, in m/s; infinite for a Car without phases."""
    phases_s = pass_sigma(1.0, poll_s, cycle_s)
    return sigma_m / phases_s if phases_s > 0.0 else math.inf


def intercept_sigma(slow_mps: float, fast_mps: float, poll_s: float, cycle_s: float) -> float:
    """Sigma of the boundary from two passes alone, in m; infinite for equal speeds."""
    if slow_mps == fast_mps:
        return math.inf
    return (math.sqrt(2.0) * slow_mps * fast_mps / abs(fast_mps - slow_mps)) * pass_sigma(1.0, poll_s, cycle_s)


def proposed_slow_speed(sigma_m: float, fast_mps: float, poll_s: float, cycle_s: float) -> float:
    """Speed of the slower of two passes at which their intercept has the sigma wanted, in m/s; below the faster."""
    phases_s = pass_sigma(1.0, poll_s, cycle_s)
    return sigma_m * fast_mps / (math.sqrt(2.0) * fast_mps * phases_s + sigma_m)
