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
from mtr_operator.history.estimate import Estimate, Known, estimate
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.same_lines import Tests
from mtr_operator.report.table import line_name

from .areas import area, rings
from .change import Change, change
from .multiplicity import ALPHA, holm
from .side_means import neighbours, side_mean
from .sides import SideLines, sides_of

# Share of the 5 % of a family for runs of adjacent lines if they can be evaluated, otherwise for means of sides.
_NEIGHBOURS_SHARE, _SIDES_SHARE = 0.6, 0.5
FARTHER, NEARER, NOT_SHOWN, NOT_KNOWN = "farther", "nearer", "no difference shown", "not known"
DISTANCE, NEIGHBOURS, SIDE, AREA, COVERAGE = "distance", "neighbours", "side", "area", "coverage"
UNITS = {DISTANCE: "m", NEIGHBOURS: "m", SIDE: "m", AREA: "m\N{SUPERSCRIPT TWO}", COVERAGE: ""}


@dataclass(frozen=True)
class Row:
    """One quantity in both sets.

    Attributes:
        quantity: DISTANCE, SIDE, AREA or COVERAGE. line: number in the first test, None for several. name: for a
            person. word: name of the distance; a mean over several distances has all their names. is_leading: one of
            the means with the larger share of the error rate. adjusted: p-value of the difference among all rows.
    """

    quantity: str
    line: int | None
    name: str
    word: str
    first: Estimate
    second: Estimate
    change: Change
    is_leading: bool = False
    adjusted: float = 1.0

    @property
    def verdict(self) -> str:
        """Return the result for this row alone."""
        if self.change.reason or (self.first.is_open and self.second.is_open and self.change.chance > ALPHA
                                  and self.change.value is None):
            return NOT_KNOWN
        if self.change.low > 0.0:
            return FARTHER
        return NEARER if self.change.high < 0.0 else NOT_SHOWN

    @property
    def is_different(self) -> bool:
        """True if the row also differs among all rows."""
        return self.verdict in (FARTHER, NEARER) and self.adjusted <= ALPHA


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
        return any(row.is_different for row in self.rows)

    def counts(self) -> dict[str, int]:
        """Return the number of distances per verdict."""
        return dict(collections.Counter(row.verdict for row in self.rows if row.quantity == DISTANCE))

    @property
    def reasons(self) -> list[str]:
        """Return the reasons why some quantities cannot be compared, each sentence once."""
        return list(dict.fromkeys(row.change.reason for row in self.rows if row.change.reason))

    @property
    def differing(self) -> list[Circumstance]:
        """Return the circumstances in which the tests differ, within the sets and between them."""
        return circumstances_of_sets(self.tests.sides[:self.split], self.tests.sides[self.split:])

    @property
    def summary(self) -> str:
        """Return the result as one sentence."""
        counts = ", ".join(f"{number} {verdict}" for verdict, number in self.counts().items()) or "no line in common"
        remaining = [row for row in self.rows if row.is_different]
        if not remaining:
            return f"No difference is shown: {counts} of the distances one by one, and none among all of them (Holm)."
        named = ", ".join(f"{row.name} {row.word}".strip() for row in remaining[:8])
        return (f"Different among all (Holm): {named}{' and more' if len(remaining) > 8 else ''}; one by one the "
                f"distances are: {counts}.")


def compare_sets(first: Sequence[Side], second: Sequence[Side]) -> Comparison:
    """Compare two sets; OperatorError if they cannot be compared."""
    if not first or not second:
        raise OperatorError("A side of the comparison has no test; mtr-results list shows what there is.")
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


def _row(what: tuple[str, int | None, str, str], known: Sequence[Known | None], split: int) -> Row:
    first, second = (estimate([each for each in side if each is not None]) for side in (known[:split], known[split:]))
    return Row(*what, first, second, change(first, second))


def _distances(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    return [_row((DISTANCE, line.number, _name(tests, line.number), word),
                 [tests.distance(test, line.number, word) for test in range(len(tests.sides))], split)
            for line in lines for word in tests.words]


def _areas(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    rows = []
    for height, ring in rings(lines):
        name = "area" if height is None else f"area at {height:.2f} m"
        for word in tests.words:
            known = [area(ring, _known(tests, test, ring, word)) for test in range(len(tests.sides))]
            rows.append(_row((AREA, None, name, word), known, split))
    return rows


def _known(tests: Tests, test: int, ring: Sequence[Any], word: str) -> dict[int, Known]:
    found = ((line.number, tests.distance(test, line.number, word)) for line in ring)
    return {number: known for number, known in found if known is not None}


def _coverages(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    rows = []
    for line in lines:
        known = [tests.coverage(test, line.number) for test in range(len(tests.sides))]
        if any(known):
            rows.append(_row((COVERAGE, line.number, _name(tests, line.number), "coverage"), known, split))
    return rows


def _sides(tests: Tests, split: int, lines: Sequence[Any]) -> list[Row]:
    """Return the means over the lines of each side: of all words together, and of each word."""
    sides = list(sides_of(lines, tests.first.progress.measured_car))
    rows = _neighbours(tests, split, sides)
    is_leading = not rows
    choices = [tests.words, *([(word,) for word in tests.words] if len(tests.words) > 1 else [])]
    for side in sides:
        for words in choices:
            found = side_mean(tests, split, side, words)
            if found is not None:
                rows.append(Row(SIDE, None, f"{side.name} ({found.distances} distances)", " and ".join(words),
                                found.first, found.second, found.change,
                                is_leading=is_leading and words == tests.words))
    return rows


def _neighbours(tests: Tests, split: int, sides: Sequence[SideLines]) -> list[Row]:
    """Return the run of adjacent lines with the largest common change; empty unless all tests have the same passes."""
    found = neighbours(tests, split, sides)
    if found is None:
        return []
    first, last = (_name(tests, number) for number in (found.numbers[0], found.numbers[-1]))
    count = len(found.numbers) * len(tests.words)
    return [Row(NEIGHBOURS, None, f"most moved together: {first} to {last} ({count} distances)",
                " and ".join(tests.words), found.first, found.second, found.change, is_leading=True)]


def _adjusted(rows: Sequence[Row]) -> list[Row]:
    """Apply Holm's correction; leading rows, if any, get their share of the error rate."""
    known = [row for row in rows if not row.change.reason]
    numbers = collections.Counter(row.is_leading for row in known)
    leading = _NEIGHBOURS_SHARE if any(row.quantity == NEIGHBOURS for row in known) else _SIDES_SHARE
    parts = {True: leading, False: 1.0 - leading}
    adjusted = holm([row.change.chance for row in known],
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
