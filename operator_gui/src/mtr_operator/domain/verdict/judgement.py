"""Verdicts on a test with guard bands of the 95 % interval: per limit and line, per line, and for the test.

A distance passes a limit if its whole interval keeps it, and fails if its whole interval breaks it; in between it is
inconclusive. A Car just beyond a limit therefore passes in at most 2.5 % of the tests, and one just inside fails in at
most 2.5 %. A line that is judged again after more attempts has wider intervals, so that all looks at it together err as
rarely (looks). Sources: JCGM 106:2012, 8.3 (guarded acceptance); ISO 14253-1, whose guard band is the expanded
uncertainty. Another quantity is judged by its own interval in the same way; its scenario defines the confidence.

If the boundary was not reached, it lies beyond the end of the test, and one end of the interval is open. A sleeping key
has the same effect: silence passes "at most" only if the key worked on some line of the test.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Callable, Sequence

from ..estimation.interval import SIGMAS_OF_LEVEL
from ..estimation.looks import deviate, is_spent
from ..results.line_result import LineResult, LineStatus, MeasuredDistance
from ..results.quantity import MeasuredQuantity
from ..scenario import Line
from .limits import Limits
from .requirement import Requirement
from .verdict import Verdict, worst


@dataclass(frozen=True)
class Circumstances:
    """Information on distances that is not part of a result.

    Attributes:
        guard_sigma_m: for a line's result and the word of a distance: 1 sigma of the errors outside its interval,
        because
            repetition does not show them.
        unreached: for the same: bounds of a boundary that was not reached.
    """

    guard_sigma_m: Callable[[LineResult, str], float] = lambda _result, _word: 0.0
    unreached: Callable[[LineResult, str], tuple[float | None, float | None]] = lambda _result, _word: (None, None)


NOTHING_KNOWN = Circumstances()
_UNTOLD = "The line does not tell this distance."
_UNTOLD_QUANTITY = "The line does not tell this."


@dataclass(frozen=True)
class Judgement:
    """Judgement of one limit on one line. reason: sentence why it is not passed; empty if it is.

    is_undecided: more measurements on the line may decide it.
    """

    requirement: Requirement
    line: int
    verdict: Verdict
    reason: str = ""
    is_undecided: bool = False


@dataclass(frozen=True)
class TestJudgement:
    """Judgement of a whole test."""

    # Otherwise pytest would collect it because of its name.
    __test__ = False

    judgements: tuple[Judgement, ...]

    @property
    def verdict(self) -> Verdict:
        """Verdict on the test: the worst one."""
        return worst(judgement.verdict for judgement in self.judgements)

    def names(self, number: int) -> bool:
        """Return True for a line with a limit."""
        return any(judgement.line == number for judgement in self.judgements)

    def of_line(self, number: int) -> Verdict:
        """Return the worst verdict on a line; NOT_SET without a limit."""
        return worst(judgement.verdict for judgement in self.judgements if judgement.line == number)

    def reason_of(self, number: int) -> str:
        """Return the first sentence about the worst verdict on a line, empty if it passes."""
        verdict = self.of_line(number)
        return next((judgement.reason for judgement in self.judgements
                     if judgement.line == number and judgement.verdict is verdict), "")

    def counts(self) -> dict[Verdict, int]:
        """Return the number of lines with a limit for each verdict, from good to bad; zeros are omitted."""
        verdicts = [self.of_line(number) for number in dict.fromkeys(each.line for each in self.judgements)]
        return {verdict: verdicts.count(verdict) for verdict in Verdict if verdict in verdicts}

    def decided(self) -> list[int]:
        """Return the numbers of the lines that pass or fail."""
        numbers = dict.fromkeys(judgement.line for judgement in self.judgements)
        return [number for number in numbers if self.of_line(number) in (Verdict.PASS, Verdict.FAIL)]

    def undecided(self) -> list[int]:
        """Return the numbers of the lines that more measurements may decide, without lines that fail anyway."""
        numbers = dict.fromkeys(judgement.line for judgement in self.judgements if judgement.is_undecided)
        return [number for number in numbers if self.of_line(number) is Verdict.INCONCLUSIVE]


def judge(limits: Limits, lines: Sequence[Line], results: Sequence[LineResult],
          circumstances: Circumstances = NOTHING_KNOWN) -> TestJudgement:
    """Judge the results; a line without a result is ABORTED."""
    by_number = {result.number: result for result in results}
    alive = {distance.word for result in results for distance in result.distances
             if distance.status is LineStatus.OK or distance.low_m is not None}
    found = []
    for line in lines:
        for requirement in limits.requirements:
            if requirement.names(line.ray):
                result = by_number.get(line.number)
                found.append(Judgement(requirement, line.number, Verdict.ABORTED, "The line was not measured.")
                             if result is None else _judge_line(requirement, result, alive, circumstances))
    return TestJudgement(tuple(found))


def _judge_line(requirement: Requirement, result: LineResult, alive: set[str],
                circumstances: Circumstances) -> Judgement:
    quantity = next((each for each in result.quantities if each.word == requirement.what), None)
    if quantity is not None:
        return _judge_quantity(requirement, result, quantity, circumstances)
    distance = _distance(requirement, result, circumstances)
    obstacle = _obstacle(requirement, result, distance, alive)
    if distance is None or obstacle:
        return Judgement(requirement, result.number, Verdict.INCONCLUSIVE, obstacle)
    guard_m = deviate(result.looks) * circumstances.guard_sigma_m(result, distance.word)
    low_m, high_m = guarded(_at_look(distance), guard_m)
    holes_m = result.holes_nearer_than(requirement.limit) if requirement.is_at_least else ()
    if holes_m:
        return Judgement(requirement, result.number, Verdict.FAIL,
                         f"Wanted is {requirement.text}; at {holes_m[0]:.2f} m attempts failed again and again.")
    judged = _compared(requirement, result, low_m, high_m)
    return replace(judged, is_undecided=judged.verdict is Verdict.INCONCLUSIVE and not is_spent(result.looks))


def _at_look(distance: MeasuredDistance) -> MeasuredDistance:
    """Return the distance with the interval for the judgement: at the level of the last look, if there was one."""
    return distance if distance.look_m is None else replace(distance, low_m=distance.look_m[0],
                                                            high_m=distance.look_m[1])


def _judge_quantity(requirement: Requirement, result: LineResult, quantity: MeasuredQuantity,
                    circumstances: Circumstances) -> Judgement:
    """Judge a quantity, which is never undecided, because its scenarios cannot measure further."""
    if not quantity.is_known:
        return Judgement(requirement, result.number, Verdict.INCONCLUSIVE, result.reason or _UNTOLD_QUANTITY)
    guard = (SIGMAS_OF_LEVEL * circumstances.guard_sigma_m(result, quantity.distance_word)
             if quantity.distance_word else 0.0)
    low, high = _widened(quantity.middle, (quantity.low, quantity.high), guard)
    if quantity.is_magnitude:
        low, high = 0.0 if low <= 0.0 <= high else min(abs(low), abs(high)), max(abs(low), abs(high))
    return _compared(requirement, result, low, high)


def _compared(requirement: Requirement, result: LineResult, low: float, high: float) -> Judgement:
    """Compare an interval with a limit, both in the limit's unit."""
    if requirement.is_at_least:
        keeps, breaks = low >= requirement.limit, high < requirement.limit
    else:
        keeps, breaks = high <= requirement.limit, low > requirement.limit
    if keeps:
        return Judgement(requirement, result.number, Verdict.PASS)
    found = f"Wanted is {requirement.text}; it {_interval_text(low, high, requirement.unit)}"
    if breaks:
        return Judgement(requirement, result.number, Verdict.FAIL, f"{found}.")
    return Judgement(requirement, result.number, Verdict.INCONCLUSIVE, f"{found}, which holds the limit.")


def _distance(requirement: Requirement, result: LineResult, circumstances: Circumstances) -> MeasuredDistance | None:
    """Return the distance of a limit; if the boundary was not reached, with the known end."""
    found = next((item for item in result.distances_at(requirement.share_percent) if item.word == requirement.what),
                 None)
    if found is None or found.status is not LineStatus.NOT_REACHED or (found.low_m, found.high_m) != (None, None):
        return found
    low_m, high_m = circumstances.unreached(result, requirement.what)
    return replace(found, low_m=low_m, high_m=high_m)


def _obstacle(requirement: Requirement, result: LineResult, distance: MeasuredDistance | None, alive: set[str]) -> str:
    """Return why a limit cannot be judged on a line, empty if it can."""
    if distance is None or distance.status is LineStatus.INVALID:
        return result.reason or _UNTOLD
    if distance.low_m is None and distance.high_m is None:
        return ("It was not reached, and the line does not tell on which side of the limit it lies."
                if distance.status is LineStatus.NOT_REACHED else "The measurement does not say how sure it is.")
    if distance.low_m is None and not requirement.is_at_least and requirement.what not in alive:
        return "The key worked nowhere in this test; it may have been asleep."
    return ""


def guarded(distance: MeasuredDistance, guard_m: float) -> tuple[float, float]:
    """Return the ends of the interval in m, each moved outwards by the errors outside it; infinite if open."""
    return _widened(distance.distance_m, (distance.low_m, distance.high_m), guard_m)


def _widened(middle: float | None, ends: tuple[float | None, float | None], guard: float) -> tuple[float, float]:
    low, high = -math.inf if ends[0] is None else ends[0], math.inf if ends[1] is None else ends[1]
    if middle is None or not low <= middle <= high:
        return low - guard, high + guard
    return middle - math.hypot(middle - low, guard), middle + math.hypot(high - middle, guard)


def _interval_text(low: float, high: float, unit: str) -> str:
    digits = 2 if unit == "m" else 1
    if math.isinf(low):
        return f"is below {high:.{digits}f} {unit}"
    if math.isinf(high):
        return f"is above {low:.{digits}f} {unit}"
    return f"lies between {low:.{digits}f} and {high:.{digits}f} {unit}"
