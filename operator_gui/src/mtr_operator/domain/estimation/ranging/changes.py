"""Distances that a phone has measured anew, among figures that a feed repeats until the next one comes."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

# With fewer values neither their spread nor the correlation of neighbours is known well enough for a 95 % interval.
MIN_CHANGES = 4


def changed_values(values_m: Sequence[float]) -> list[float]:
    """Return each value that differs from the one before it, in m.

    A repeated figure carries no new information, so equal neighbours count once. The first value is left out: it may
    have been measured before the robot stopped.
    """
    return [value_m for before_m, value_m in zip(values_m, values_m[1:]) if value_m != before_m]
