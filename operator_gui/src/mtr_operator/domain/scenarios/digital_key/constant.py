"""Feeds that tell one and the same figure wherever the phone is."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from typing import Sequence

from ...results.line_result import LineStatus
from .reading import Answer
from .result import DigitalKeyResult

# Coarse figures may be the same at places whose distances differ by less.
_SPAN_M = 1.0
# So many places, and all there are: nobody tells one figure at each of them by chance.
_MIN_PLACES = 3


def constant_reason(figure_m: float, nearest_m: float, farthest_m: float) -> str:
    """What is wrong with a figure that was told at two distances."""
    return (f"The phone's distance was {figure_m:.2f} m without any change at places {nearest_m:.2f} and "
            f"{farthest_m:.2f} m away; the feed is frozen or at the end of its range.")


def beside_others(result: DigitalKeyResult, measured: Sequence[DigitalKeyResult]) -> DigitalKeyResult:
    """The same place, invalid when those measured before it show that its figure is none; an earlier result of its own
    says nothing."""
    earlier = [each for each in measured if each.number != result.number]
    reason = is_constant_with(result, earlier) if result.status is LineStatus.OK else ""
    return as_constant(result, reason) if reason else result


def is_constant_with(result: DigitalKeyResult, earlier: Sequence[DigitalKeyResult]) -> str:
    """Why this result's figure is none, as far as the places before it show that; empty when they do not."""
    alike = [each for each in (*earlier, result) if _only_figure(each) is not None
             and _only_figure(each) == _only_figure(result)]
    return _reason(alike) if result in alike and _span_m(alike) >= _SPAN_M else ""


def revised(results: Sequence[DigitalKeyResult]) -> list[DigitalKeyResult]:
    """Places that count for nothing now that all are known: each group of one figure over a span, or at all places."""
    answered = [each for each in results if each.answer in (Answer.DISTANCE.value, Answer.CONSTANT.value)]
    figures_m = {figure_m for each in answered if (figure_m := _only_figure(each)) is not None}
    found: list[DigitalKeyResult] = []
    for figure_m in sorted(figures_m):
        alike = [each for each in answered if _only_figure(each) == figure_m]
        if _span_m(alike) >= _SPAN_M or (len(alike) == len(answered) and len(alike) >= _MIN_PLACES):
            found += [as_constant(each, _reason(alike)) for each in alike if each.status is LineStatus.OK]
    return found


def as_constant(result: DigitalKeyResult, reason: str) -> DigitalKeyResult:
    """The same place, invalid."""
    return replace(result, status=LineStatus.INVALID, answer=Answer.CONSTANT.value, reason=reason, error_m=None,
                   error_low_m=None, error_high_m=None)


def _only_figure(result: DigitalKeyResult) -> float | None:
    """What all figures of a place are; None when they differ, or none count."""
    counts = result.answer in (Answer.DISTANCE.value, Answer.CONSTANT.value) and len(set(result.figures_m)) == 1
    return result.figures_m[0] if counts else None


def _span_m(results: Sequence[DigitalKeyResult]) -> float:
    distances_m = _references(results)
    return max(distances_m) - min(distances_m) if distances_m else 0.0


def _reason(alike: Sequence[DigitalKeyResult]) -> str:
    distances_m = _references(alike)
    return constant_reason(alike[0].figures_m[0], min(distances_m), max(distances_m))


def _references(results: Sequence[DigitalKeyResult]) -> list[float]:
    return [each.reference_m for each in results if each.reference_m is not None]
