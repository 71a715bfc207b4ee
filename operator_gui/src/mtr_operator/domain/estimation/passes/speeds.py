"""Maximum speed of the key in a pass for a given error budget.

The key moves between the Car's polls and between the bus messages. Both phases are uniform and independent, so the
boundary from one pass has a sigma of

    v * sqrt((poll_s^2 + cycle_s^2) / 12),

in addition to the mean reaction time v * tau, which passes at two speeds eliminate. From two passes alone, without
other axes that determine tau, the intercept has sigma  sqrt(2) v1 v2 / |v2 - v1| * sqrt((poll_s^2 + cycle_s^2) / 12).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math


def pass_sigma(speed_mps: float, poll_s: float, cycle_s: float) -> float:
    """Return the sigma of one pass, in m."""
    return speed_mps * math.sqrt((poll_s ** 2 + cycle_s ** 2) / 12.0)


def proposed_speed(sigma_m: float, poll_s: float, cycle_s: float) -> float:
    """Return the speed at which one pass has the required sigma, in m/s; infinite for a Car without phases."""
    phases_s = pass_sigma(1.0, poll_s, cycle_s)
    return sigma_m / phases_s if phases_s > 0.0 else math.inf


def intercept_sigma(slow_mps: float, fast_mps: float, poll_s: float, cycle_s: float) -> float:
    """Return the sigma of the boundary from two passes alone, in m; infinite for equal speeds."""
    if slow_mps == fast_mps:
        return math.inf
    return (math.sqrt(2.0) * slow_mps * fast_mps / abs(fast_mps - slow_mps)) * pass_sigma(1.0, poll_s, cycle_s)


def proposed_slow_speed(sigma_m: float, fast_mps: float, poll_s: float, cycle_s: float) -> float:
    """Return the slower speed of two passes for the required sigma of their intercept, in m/s; below the faster one."""
    phases_s = pass_sigma(1.0, poll_s, cycle_s)
    return sigma_m * fast_mps / (math.sqrt(2.0) * fast_mps * phases_s + sigma_m)
