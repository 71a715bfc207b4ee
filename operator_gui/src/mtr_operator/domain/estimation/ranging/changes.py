"""Extracts newly measured phone distances from a feed that repeats each value until the next one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

# With fewer values, their spread and the correlation of neighbours are too uncertain for a 95 % interval.
MIN_CHANGES = 4


def changed_values(values_m: Sequence[float]) -> list[float]:
    """Return each value that differs from the previous one, in m.

    A repeated value carries no new information, so equal neighbours count once. The first value is omitted: it may have
    been measured before the robot stopped.
    """
    return [value_m for before_m, value_m in zip(values_m, values_m[1:]) if value_m != before_m]
