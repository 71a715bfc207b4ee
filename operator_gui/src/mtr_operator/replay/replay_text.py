"""Result of a replay, for people and programs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterator

from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance
from mtr_operator.domain.scenario import AnyScenario

from .points import Point
from .replay import SAME_M, ReplayedTest, is_same

_MM_PER_M = 1000.0


def replay_lines(scenario: AnyScenario, found: ReplayedTest) -> Iterator[str]:
    """Yield the changes, and the agreement of the rest."""
    for result, former, new in found.changed_lines:
        yield (f"{scenario.line_word} {result.number} ({result.place}), {former.word}: {_text(former)} in the record, "
               f"{_text(new)} now")
    for number, point in found.points:
        if point.new_status is not point.status:
            yield f"{scenario.line_word} {number}, {point.word}: {_outcome(point.status)} in the record, " \
                  f"{_outcome(point.new_status)} now{_because(point)}"
    for result in found.recorded:
        after = found.attempts[result.number].after if result.number in found.attempts else None
        if after is not None and after.new_status is LineStatus.OK:
            place = "" if after.new_distance is None else f" at {after.new_distance.distance_m:.4f} m"
            yield (f"{scenario.line_word} {result.number} ({result.place}) is invalid in the record; now the Car would "
                   f"have reacted to {after.word}{place}. Its reason was: {result.reason}")
    yield summary(found)


def summary(found: ReplayedTest) -> str:
    """Return a summary of one line."""
    distances, points = sum(len(result.distances) for result in found.recorded), len(found.points)
    worst = f"the largest difference is {_MM_PER_M * found.worst_m:.3f} mm"
    if not found.is_whole:
        return (f"{len(found.changed_lines)} of {distances} distances would change as far as the log tells; whether "
                "the others are as in the record it does not say.")
    if is_unchanged(found):
        return f"{distances} distances and {points} measurements are as in the record; {worst}."
    return f"{len(found.changed_lines)} of {distances} distances would change; {worst}."


def is_unchanged(found: ReplayedTest) -> bool:
    """Return True if the log covers the test, and all distances and outcomes match the record to a tenth of a
    millimetre."""
    return (found.is_whole and not found.changed_lines and found.worst_m <= SAME_M
            and all(point.status is point.new_status for _, point in found.points))


def replay_document(scenario: AnyScenario, found: ReplayedTest) -> dict[str, Any]:
    """Return the result as plain values."""
    return {"scenario": scenario.name, "is_unchanged": is_unchanged(found), "worst_m": found.worst_m,
            "is_whole": found.is_whole, "measurements": len(found.points), "notices": list(found.notices), "lines": [
                {"line": old.number, "place": old.place, "distances": [
                    {"word": former.word, "is_same": is_same(former, new), "recorded": _values(former),
                     "now": _values(new)} for former, new in zip(old.distances, now.distances)]}
                for old, now in zip(found.recorded, found.now)]}


def _values(distance: MeasuredDistance) -> dict[str, Any]:
    return {"status": distance.status.value, "distance_m": distance.distance_m, "low_m": distance.low_m,
            "high_m": distance.high_m}


def _text(distance: MeasuredDistance) -> str:
    if distance.distance_m is not None:
        return f"{distance.distance_m:.4f} m"
    ends = [f"{word} {end:.4f} m" for word, end in (("above", distance.low_m), ("below", distance.high_m))
            if end is not None]
    return ", ".join([distance.status.value.replace("_", " "), *ends])


def _outcome(status: LineStatus) -> str:
    return {LineStatus.OK: "the Car reacted", LineStatus.NOT_REACHED: "the Car did not react",
            LineStatus.INVALID: "doubtful"}[status]


def _because(point: Point) -> str:
    return f": {point.doubt}" if point.doubt else ""
