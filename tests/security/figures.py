"""Figures of times that were measured. No robot inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Sequence


def percentile(values: Sequence[float], share: float) -> float:
    """The smallest value below which that share of them lies; ValueError for none."""
    if not values:
        raise ValueError("No value was measured.")
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)]
