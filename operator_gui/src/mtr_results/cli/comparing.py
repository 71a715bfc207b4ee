"""Commands that compare tests."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
from typing import Iterator

from mtr_operator.cli.exit_codes import EXIT_PASS
from mtr_operator.domain.estimation.components import Spread
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.history.circumstances import differing_names
from mtr_operator.history.same_lines import Tests
from mtr_operator.history.spread import distance_spread
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.documents import comparison_document
from mtr_operator.history.statistics.texts import comparison_lines
from mtr_operator.report.figures import ends_text
from mtr_operator.report.table import line_name
from mtr_operator.terminal import show

from ..statistics.capability import Capability, capability
from ..statistics.documents import capability_document, spread_document, trend_document
from ..statistics.trend import trend
from ..store.sets import TestSet, read_set
from .meant import place_of
from .output import print_json


def compare(options: argparse.Namespace) -> int:
    """Print the differences between the first set and the second one."""
    with place_of(options).open().reading() as connection:
        first, second = (read_set(connection, text) for text in (options.first, options.second))
    found = compare_sets(first.sides, second.sides)
    if options.json:
        print_json(comparison_document(found))
        return EXIT_PASS
    for number, side in ((1, first), (2, second)):
        show(f"Side {number}: {side.text}, {len(side.rows)} tests from {side.rows[0]['started']}")
    for line in comparison_lines(found):
        show(line)
    return EXIT_PASS


def spread(options: argparse.Namespace) -> int:
    """Print the sources of spread of each distance."""
    tests, chosen = _read(options)
    factors = {name: chosen.values(name) for name in options.by.split(",") if name}
    found = [(name, distance_spread(tests, line, word, factors))
             for line, word, name in _distances(tests, options.line, options.word)]
    if options.json:
        print_json([{"line": each.line.number, "name": name, "what": each.word, "without_value": each.without,
                     "differs": differing_names(tests.sides), "mean_reason": each.mean.reason,
                     **spread_document(each.spread),
                     **capability_document(capability(each.spread, options.at_least, options.at_most))}
                    for name, each in found])
        return EXIT_PASS
    _say_differing(tests)
    for name, each in found:
        show(f"{name} {each.word}: {each.spread.count} tests, {each.without} without a value")
        if each.mean.reason:
            show(f"  {each.mean.reason}")
        if each.spread.reason:
            show(f"  {each.spread.reason}")
            continue
        for row in (*_spread_texts(each.spread), *_capability_texts(capability(each.spread, options.at_least,
                                                                               options.at_most))):
            show(f"  {row}")
    return EXIT_PASS


def _spread_texts(found: Spread) -> list[str]:
    return [f"mean {found.mean:.3f} m, repeatability {found.repeatability:.3f} m, reproducibility "
            f"{found.reproducibility:.3f} m (1 sigma)",
            *(f"{part.factor} ({part.levels}): {part.sigma:.3f} m, 95 % {ends_text(part.low, part.high)}"
              for part in found.components), *(f"left out: {sentence}" for sentence in found.left_out)]


def _capability_texts(found: Capability | None) -> list[str]:
    if found is None:
        return []
    indices = (("Cpk, by repeatability", found.within), ("Ppk, by reproducibility", found.overall))
    return [f"{name}: {index.value:.2f}, 95 % {ends_text(index.low, index.high)}" for name, index in indices]


def show_trend(options: argparse.Namespace) -> int:
    """Print each distance over time, with control limits."""
    tests, chosen = _read(options)
    document = []
    if not options.json:
        _say_differing(tests)
    for line, word, name in _distances(tests, options.line, options.word):
        found = trend([tests.distance(test, line.number, word) for test in range(len(tests.sides))], options.baseline)
        document.append({"line": line.number, "name": name, "what": word, **trend_document(found)})
        if not options.json:
            limits = found.reason or f"mean {found.centre:.3f} m, limits {found.low:.3f} to {found.high:.3f} m"
            show(f"{name} {word}: {limits}")
            if found.unlike:
                show(f"  {found.unlike}")
            for index in found.beyond:
                show(f"  beyond: test {chosen.rows[index]['id']} of {chosen.rows[index]['started']}")
    if options.json:
        print_json({"tests": [row["id"] for row in chosen.rows], "differs": differing_names(tests.sides),
                    "distances": document})
    return EXIT_PASS


def _say_differing(tests: Tests) -> None:
    """Print the properties in which the tests of a set differ, because they may shift the distances."""
    names = differing_names(tests.sides)
    if names:
        show(f"The tests differ in: {', '.join(names)}.")


def _read(options: argparse.Namespace) -> tuple[Tests, TestSet]:
    with place_of(options).open().reading() as connection:
        chosen = read_set(connection, options.set)
    return Tests(chosen.sides), chosen


def _distances(tests: Tests, line: int, word: str) -> Iterator[tuple[LineResult, str, str]]:
    """Yield line, word and name of each distance; line 0 and an empty word select all."""
    for result in tests.first.progress.results:
        if line in (0, result.number):
            yield from ((result, each, line_name(tests.first.scenario, result)) for each in tests.words
                        if word in ("", each))
