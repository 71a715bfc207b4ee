"""Comparison of two sets of tests: distances, sides, areas, verdicts. A set is one test or repetitions of it.

A quantity is different if the whole 95 % interval of its difference is on one side of zero. It is different among all
if it also passes Holm's correction. All quantities of a comparison are one family: without a true difference, at least
95 % of the comparisons report none.

An antenna moves adjacent lines together. If all tests have passes at the same speeds, three fifths of the 5 % are
therefore assigned to runs of adjacent lines (neighbours.py). Otherwise half of it is assigned to the few means over the
lines of a side, with all words together.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from dataclasses import dataclass, replace
from typing import Any, Sequence

from mtr_operator.domain.errors import OperatorError
from mtr_operator.history.circumstances import Circumstance, circumstances_of_sets
from mtr_operator.history.estimate import NOT_MEASURED, Estimate, Known, estimate
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.same_lines import Tests
from mtr_operator.report.table import line_name

from .areas import area, rings
from .difference import Change, difference
from .multiplicity import ALPHA, holm
from .row import AREA, COVERAGE, DISTANCE, NEIGHBOURS, SIDE, Row
from .side_means import neighbours, side_mean
from .sides import SideLines, sides_of

# Share of the 5 % of a family for runs of adjacent lines if they can be evaluated, otherwise for means of sides.
_NEIGHBOURS_SHARE, _SIDES_SHARE = 0.6, 0.5
# Names of differing quantities in the summary.
MAX_NAMED = 8


@dataclass(frozen=True)
class Comparison:
    """Result of a comparison.

    Attributes: tests: both sets, one after the other. split: number of tests in the first set. rows: distances line by
    line, then areas and coverage. holes: places of holes of each set, only for lines that have one. verdicts: counts of
    verdicts in each set. only_first, only_second: names of lines that no test of the other set has.
    """

    tests: Tests
    split: int
    rows: tuple[Row, ...]
    holes: tuple[tuple[str, str, str], ...]
    verdicts: tuple[dict[str, int], dict[str, int]]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]

    @property
    def is_different(self) -> bool:
        """True if a distance, an area or a coverage differs after the correction for the number of comparisons."""
        return bool(self.different)

    @property
    def distances(self) -> list[Row]:
        """Return the rows of single distances, line by line."""
        return [row for row in self.rows if row.quantity == DISTANCE]

    def counts(self) -> dict[Change, int]:
        """Return the number of distances per result for the distance alone."""
        return dict(collections.Counter(row.change for row in self.distances))

    @property
    def different(self) -> list[Row]:
        """Return the rows that differ after the correction for the number of comparisons."""
        return [row for row in self.rows if row.is_different]

    @property
    def expected_by_chance(self) -> float:
        """Mean number of distances whose intervals would exclude zero without a true difference."""
        return ALPHA * sum(number for change, number in self.counts().items() if change is not Change.NOT_KNOWN)

    @property
    def reasons(self) -> list[str]:
        """Return the reasons why some quantities cannot be compared, each sentence once."""
        return list(dict.fromkeys(row.difference.reason for row in self.rows if row.difference.reason))

    @property
    def differing(self) -> list[Circumstance]:
        """Return the circumstances in which the tests differ, within the sets and between them."""
        return circumstances_of_sets(self.tests.sides[:self.split], self.tests.sides[self.split:])

    @property
    def summary(self) -> str:
        """Return the result as one sentence."""
        counts = ", ".join(f"{number} {change.value}" for change, number in self.counts().items())
        counts = counts or "no line in common"
        if not self.different:
            return f"No difference is shown: {counts} of the distances one by one, and none among all of them (Holm)."
        named = ", ".join(f"{row.title} {row.word}".strip() for row in self.different[:MAX_NAMED])
        more = " and more" if len(self.different) > MAX_NAMED else ""
        return f"Different among all (Holm): {named}{more}; one by one the distances are: {counts}."


def compare_sets(first: Sequence[Side], second: Sequence[Side]) -> Comparison:
    """Compare two sets; OperatorError if they cannot be compared."""
    if not first or not second:
        raise OperatorError("A side of the comparison has no test.")
    tests = Tests([*first, *second])
    split = len(first)
    lines = [line for line in tests.first.scenario.lines(tests.first.parameters, tests.first.progress.measured_car)
             if _in_both(tests, split, line.number)]
    rows = _adjusted([*_distances(tests, split, lines), *_sides(tests, split, lines), *_areas(tests, split, lines),
                      *_coverages(tests, split, lines)])
    return Comparison(tests, split, tuple(rows), _holes(tests, split), _verdicts(tests, split),
                      *_alone(tests, split))


def _in_both(tests: Tests, split: int, line: int) -> bool:
    return all(any(line in results for results in side) for side in (tests.results[:split], tests.results[split:]))


def _distances(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    return [_distance(tests, split, line.number, word) for line in lines for word in tests.words]


def _distance(tests: Tests, split: int, line: int, word: str) -> Row:
    first, second = (_estimate(tests, side, line, word) for side in _halves(tests, split))
    return Row(DISTANCE, (line,), _name(tests, line), (word,), first, second, difference(first, second))


def _halves(tests: Tests, split: int) -> tuple[range, range]:
    """Return the indices of the tests of both sets."""
    return range(split), range(split, len(tests.sides))


def _estimate(tests: Tests, side: Sequence[int], line: int, word: str) -> Estimate:
    known = [each for test in side if (each := tests.distance(test, line, word)) is not None]
    return estimate(known, tests.why_unknown(side[0], line, word) if len(side) == 1 and not known else NOT_MEASURED)


def _row(what: tuple[str, tuple[int, ...], str, tuple[str, ...]], known: Sequence[Known | None], split: int) -> Row:
    first, second = (estimate([each for each in side if each is not None]) for side in (known[:split], known[split:]))
    return Row(*what, first, second, difference(first, second))


def _areas(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    rows = []
    for height, ring in rings(lines):
        name = "area" if height is None else f"area at {height:.2f} m"
        numbers = tuple(line.number for line in ring)
        for word in tests.words:
            known = [area(ring, _known(tests, test, ring, word)) for test in range(len(tests.sides))]
            rows.append(_row((AREA, numbers, name, (word,)), known, split))
    return rows


def _known(tests: Tests, test: int, ring: Sequence[Any], word: str) -> dict[int, Known]:
    found = ((line.number, tests.distance(test, line.number, word)) for line in ring)
    return {number: known for number, known in found if known is not None}


def _coverages(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    rows = []
    for line in lines:
        known = [tests.coverage(test, line.number) for test in range(len(tests.sides))]
        if any(known):
            rows.append(_row((COVERAGE, (line.number,), _name(tests, line.number), ("coverage",)), known, split))
    return rows


def _sides(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    """Return the means over the lines of each side: of all words together, and of each word."""
    sides = list(sides_of(lines, tests.first.progress.measured_car))
    rows = _neighbours(tests, split, sides)
    is_leading = not rows
    choices: list[tuple[str, ...]] = [tests.words, *([(word,) for word in tests.words] if len(tests.words) > 1 else [])]
    for side in sides:
        for words in choices:
            found = side_mean(tests, split, side, words)
            if found is not None:
                rows.append(Row(SIDE, side.numbers, side.name, words, found.first, found.second, found.difference,
                                found.distances, is_leading and words == tests.words))
    return rows


def _neighbours(tests: Tests, split: int, sides: Sequence[SideLines]) -> list[Row]:
    """Return the run of adjacent lines with the largest common change; empty unless all tests have the same passes."""
    found = neighbours(tests, split, sides)
    if found is None:
        return []
    first, last = (_name(tests, number) for number in (found.numbers[0], found.numbers[-1]))
    return [Row(NEIGHBOURS, found.numbers, f"most moved together: {first} to {last}", tests.words, found.first,
                found.second, found.difference, len(found.numbers) * len(tests.words), is_leading=True)]


def _adjusted(rows: Sequence[Row]) -> list[Row]:
    """Apply Holm's correction; leading rows, if any, get their share of the error rate."""
    known = [row for row in rows if not row.difference.reason]
    numbers = collections.Counter(row.is_leading for row in known)
    leading = _NEIGHBOURS_SHARE if any(row.quantity == NEIGHBOURS for row in known) else _SIDES_SHARE
    parts = {True: leading, False: 1.0 - leading}
    adjusted = holm([row.difference.chance for row in known],
                    [parts[row.is_leading] / numbers[row.is_leading] for row in known])
    of_known = dict(zip(map(id, known), adjusted))
    return [replace(row, adjusted=of_known.get(id(row), 1.0)) for row in rows]


def _name(tests: Tests, line: int) -> str:
    result = next(results[line] for results in tests.results if line in results)
    word = tests.first.scenario.line_word
    # The line number is the one of the first test, also if the result belongs to another test.
    return line_name(tests.first.scenario, result) if line == result.number else f"{word} {line} ({result.place})"


def _holes(tests: Tests, split: int) -> tuple[tuple[str, str, str], ...]:
    found = []
    for line in sorted({line for results in tests.results for line in results}):
        mine, its = (", ".join(dict.fromkeys(text for results in side if line in results
                                         for text in getattr(results[line], "holes_m", "").split()))
                     for side in (tests.results[:split], tests.results[split:]))
        if mine or its:
            found.append((_name(tests, line), mine, its))
    return tuple(found)


def _verdicts(tests: Tests, split: int) -> tuple[dict[str, int], dict[str, int]]:
    words = [tests.verdict(test).word for test in range(len(tests.sides))]
    return dict(collections.Counter(words[:split])), dict(collections.Counter(words[split:]))


def _alone(tests: Tests, split: int) -> tuple[tuple[str, ...], tuple[str, ...]]:
    first, second = ({line for results in side for line in results}
                     for side in (tests.results[:split], tests.results[split:]))
    only_first = tuple(_name(tests, line) for line in sorted(first - second))
    # Lines at places that the first test does not have are identified by their names only.
    elsewhere = dict.fromkeys(name for alone in tests.alone[split:] for name in alone)
    return only_first, (*(_name(tests, line) for line in sorted(second - first)), *elsewhere)
