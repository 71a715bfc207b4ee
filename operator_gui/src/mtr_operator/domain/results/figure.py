"""What may honestly be said of a distance: a value, one end, two places between which it lies, or nothing."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from .line_result import LineStatus, MeasuredDistance


class Kind(enum.Enum):
    """How much is known."""

    VALUE = "value"
    AT_LEAST = "at least"
    AT_MOST = "at most"
    BETWEEN = "between"
    NOT_REACHED = "not reached"
    INVALID = "invalid"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Figure:
    """first_m: the value, the only end or the nearer one; second_m: the farther of two. None where there is none."""

    kind: Kind
    first_m: float | None = None
    second_m: float | None = None


def figure_of(distance: MeasuredDistance, unreached: tuple[float | None, float | None] = (None, None)) -> Figure:
    """unreached: between which distances a boundary lies that was not reached, see Judging.unreached."""
    if distance.status is LineStatus.INVALID:
        return Figure(Kind.INVALID)
    if distance.status is LineStatus.NOT_REACHED:
        low_m = unreached[0] if distance.low_m is None else distance.low_m
        ends = (distance.high_m, distance.failed_m, unreached[1])
        return between(low_m, next((end for end in ends if end is not None), None))
    if distance.is_place:
        return between(distance.distance_m, distance.failed_m)
    if distance.is_open:
        return interval_of(distance) or Figure(Kind.UNKNOWN)
    return Figure(Kind.VALUE, distance.distance_m)


def interval_of(distance: MeasuredDistance) -> Figure | None:
    """The 95 % interval of the boundary, also where only one of its ends is known; None where the method gives none."""
    figure = between(distance.low_m, distance.high_m)
    return None if figure.kind is Kind.NOT_REACHED else figure


def between(low_m: float | None, high_m: float | None) -> Figure:
    """What two ends say, or one of them."""
    if low_m is not None and high_m is not None:
        return Figure(Kind.BETWEEN, low_m, high_m)
    if low_m is not None:
        return Figure(Kind.AT_LEAST, low_m)
    return Figure(Kind.NOT_REACHED) if high_m is None else Figure(Kind.AT_MOST, high_m)
