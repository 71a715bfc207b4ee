"""Mean of the distances of a side, which shows common changes, as by an antenna.

If all tests have passes at the same speeds, it is the mean of their events (same_passes.py). Otherwise each test has
its own mean over the lines that are known in all tests. In its interval, independent errors of lines decrease with the
number of lines; common errors count in full (MOVER for a sum, by Zou and Donner).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Sequence

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.history.estimate import Estimate, Known, estimate
from mtr_operator.history.same_lines import Tests

from .difference import Difference, difference
from .neighbours import Neighbours, moved_most
from .same_passes import Events, events_of, moved
from .sides import SideLines


@dataclass(frozen=True)
class SideMean:
    """Attributes: distances: number of averaged distances. first, second: of both sets. difference: second less
    first."""

    distances: int
    first: Estimate
    second: Estimate
    difference: Difference


def side_mean(tests: Tests, split: int, side: SideLines, words: Sequence[str]) -> SideMean | None:
    """Return the mean of the distances of these words on a side; None if no line is known in all tests."""
    events = [of_word for word in words if (of_word := _events(tests, side, word))]
    if len(events) == len(words):
        return SideMean(sum(map(len, events)), *moved(events, split, _lasting_m(tests, side, words)))
    parts = [(line, word) for word in words for line in side.numbers if _is_known(tests, line, word)]
    if not parts:
        return None
    known = [mean_of([found for part in parts if (found := tests.distance(test, *part)) is not None])
             for test in range(len(tests.sides))]
    first, second = estimate(known[:split]), estimate(known[split:])
    return SideMean(len(parts), first, second, difference(first, second))


def neighbours(tests: Tests, split: int, sides: Sequence[SideLines]) -> Neighbours | None:
    """Return the run of adjacent lines with the largest common change. sides: those with a place, and all lines."""
    found = {line: [_events_on(tests, line, word) for word in tests.words] for side in sides for line in side.numbers}
    events = {line: [each for each in of_words if each] for line, of_words in sorted(found.items())
              if None not in of_words}
    named = [side for side in sides if side.is_one_side]
    lasting_m = max((_lasting_m(tests, side, tests.words) for side in sides), default=0.0)
    return moved_most(events, [side.numbers for side in named], split, lasting_m)


def _events(tests: Tests, side: SideLines, word: str) -> list[Events]:
    """Return the events of each line on which all tests have the same passes."""
    found = (_events_on(tests, line, word) for line in side.numbers)
    return [each for each in found if each is not None]


def _events_on(tests: Tests, line: int, word: str) -> Events | None:
    number = tests.words.index(word)
    if not all(line in results and results[line].distances[number].status is LineStatus.OK
               for results in tests.results):
        return None
    return events_of([results[line] for results in tests.results], word)


def _lasting_m(tests: Tests, side: SideLines, words: Sequence[str]) -> float:
    """Return 1 sigma of errors, without the Car's timing, that are common to all lines of one test only."""
    return max(math.hypot(lasting.robot_m, tests.outline_scatter_m(line) if tests.is_same_car else lasting.outline_m)
               for test, results in enumerate(tests.results) for line in side.numbers if line in results
               for lasting in (tests.lasting_sigmas(test, line, word) for word in words))


def _is_known(tests: Tests, line: int, word: str) -> bool:
    """True if all tests know the distance and one has a value; a distance that no test reached cannot be averaged."""
    known = [tests.distance(test, line, word) for test in range(len(tests.sides))]
    return None not in known and any(each is not None and each.value is not None for each in known)


def mean_of(parts: Sequence[Known]) -> Known:
    """Return the mean of the distances of one test, at least one."""
    count = len(parts)
    low, high = (sum(getattr(each, end) for each in parts) / count for end in ("low", "high"))
    value = None if any(each.value is None for each in parts) else low
    coherent, *others = (sum(getattr(each, name) for each in parts) / count
                         for name in ("coherent", "shared", "alike", "alike_timing"))
    reason = next((each.reason for each in parts if each.reason), "")
    return replace(Known(value, low, high, _ends(parts, value, coherent), coherent, *others), reason=reason)


def _ends(parts: Sequence[Known], value: float | None, coherent: float) -> tuple[float, float] | None:
    if any(each.ends is None for each in parts):
        return None
    ends = [each.ends for each in parts if each.ends is not None]
    if value is None:
        return sum(low for low, _ in ends) / len(ends), sum(high for _, high in ends) / len(ends)
    below, above = (math.sqrt(sum(_own(each, ends_of[side]) for each, ends_of in zip(parts, ends))) / len(parts)
                    for side in (0, 1))
    reach = SIGMAS_OF_LEVEL * coherent
    return value - math.hypot(below, reach), value + math.hypot(above, reach)


def _own(each: Known, end: float) -> float:
    """Return the square of the deviation of an end from the value by independent errors of the line."""
    return max(((each.value or 0.0) - end) ** 2 - (SIGMAS_OF_LEVEL * each.coherent) ** 2, 0.0)
