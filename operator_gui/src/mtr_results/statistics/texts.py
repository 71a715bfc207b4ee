"""Values and intervals as text, with open ends marked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.history.estimate import Estimate

from .comparison import Row

MEANING = ("A quantity is called different only where the whole 95 % interval of its difference lies on one side of "
           "zero, and different among all only where that remains after Holm's correction for their number (*). Where "
           "one of them is only known to lie beyond an end, so is the difference. A side's figure is the mean over its "
           "lines; of passes at the same speeds in all tests it is that of the places at which the Car reacted.")


def interval_text(low: float, high: float, sign: str = "") -> str:
    """Return both ends, the known end, or an empty text."""
    if math.isfinite(low) and math.isfinite(high):
        return f"{low:{sign}.2f} to {high:{sign}.2f}"
    if math.isfinite(low):
        return f"at least {low:{sign}.2f}"
    return f"at most {high:{sign}.2f}" if math.isfinite(high) else ""


def estimate_text(estimate: Estimate) -> str:
    """Return the value, or its interval if there is no value."""
    if estimate.value is not None:
        return f"{estimate.value:.2f}"
    return interval_text(estimate.low, estimate.high) or "unknown"


def row_texts(row: Row) -> tuple[str, ...]:
    """Return the cells of a table row: name, both sides, difference, its interval, p-value among all, verdict."""
    change = row.change
    return (f"{row.name} {row.word if row.word not in row.name else ''}".rstrip(), estimate_text(row.first),
            estimate_text(row.second), "" if change.value is None else f"{change.value:+.2f}",
            "" if change.reason else interval_text(change.low, change.high, "+"),
            "" if change.reason else chance_text(row.adjusted), row.verdict + (" *" if row.is_different else ""))


def chance_text(chance: float) -> str:
    """Return a p-value; small ones have an upper bound instead of zero."""
    return "< 0.001" if chance < 0.001 else f"{chance:.3f}"
