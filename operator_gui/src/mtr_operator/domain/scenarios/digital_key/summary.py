"""All places of a digital key together, in words and figures."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...estimation.ranging.error_summary import summarize
from .result import DigitalKeyResult

_CM_PER_M = 100.0


def summary_of(results: Sequence[DigitalKeyResult]) -> list[tuple[str, str]]:
    """A name and a text each; errors in cm."""
    errors_m = [each.error_m for each in results if each.error_m is not None]
    stood = [each for each in results if each.error_m is not None or each.is_unanswered]
    rows: list[tuple[str, str]] = []
    # At its worst the robot's own error is the same at all places: that of the map it has of the Car.
    sigmas_m = [each.uncertainty_m for each in results if each.error_m is not None and each.uncertainty_m is not None]
    found = summarize(errors_m, max(sigmas_m, default=0.0))
    if found is not None:
        rows += [("bias", _with_interval(found.bias_m, found.bias_low_m, found.bias_high_m, "+.1f")),
                 ("95 % of errors within", _with_interval(found.within_m, found.within_low_m, found.within_high_m,
                                                          ".1f"))]
        if found.spread_m is not None:
            rows.insert(1, ("spread of errors", f"{_CM_PER_M * found.spread_m:.1f} cm"))
    if stood:
        silent = sum(each.is_unanswered for each in stood)
        rows.append(("places without answer", f"{silent} / {len(stood)} ({100.0 * silent / len(stood):.0f} %)"))
    return rows


def _with_interval(value_m: float, low_m: float | None, high_m: float | None, form: str) -> str:
    """Such as "+4.2 cm (+3.1 ... +5.3)"; an end that nobody knows is a question mark."""
    if low_m is None and high_m is None:
        return f"{_CM_PER_M * value_m:{form}} cm (? ... ?)"
    ends = ("?" if end_m is None else f"{_CM_PER_M * end_m:{form}}" for end_m in (low_m, high_m))
    return f"{_CM_PER_M * value_m:{form}} cm ({' ... '.join(ends)})"
