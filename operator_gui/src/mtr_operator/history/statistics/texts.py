"""A comparison as text: values, intervals and results, with open ends marked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.history.estimate import Estimate
from mtr_operator.report.figures import Number, ends_text, plain_number

from .comparison import Comparison
from .row import Row

_HEADINGS = ("", "first", "second", "second - first", "95 %", "chance of all", "")
_WORDS = (0, len(_HEADINGS) - 1)
_GAP = "  "
# Smaller p-values are shown by this bound.
_MIN_CHANCE = 0.001
MEANING = ("A quantity differs if the whole 95 % interval of its difference is on one side of zero. A star marks those "
           "that also differ among all, after Holm's correction for their number. If only one end of a distance is "
           "known, only one end of the difference is. The value of a side is the mean over its lines; with passes at "
           "the same speeds in all tests, it is the mean of the places at which the Car reacted.")


def comparison_lines(comparison: Comparison) -> Iterator[str]:
    """Yield what else differs, the table of all quantities, and the result."""
    for each in comparison.differing:
        yield f"  {each.name}: {each.first or 'nothing'} / {each.second or 'nothing'}"
    yield from _table([_HEADINGS, *map(row_texts, comparison.rows)])
    for reason in comparison.reasons:
        yield f"not known: {reason}"
    for name, mine, its in comparison.holes:
        yield f"holes on {name}: {mine or 'none'} / {its or 'none'}"
    yield "verdicts: " + " / ".join(", ".join(f"{count} {word}" for word, count in each.items())
                                    for each in comparison.verdicts)
    for number, names in ((1, comparison.only_first), (2, comparison.only_second)):
        if names:
            yield f"Only on side {number}: {', '.join(names)}"
    yield MEANING
    yield comparison.summary


def _table(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEADINGS))]
    for row in rows:
        cells = (cell.ljust(width) if index in _WORDS else cell.rjust(width)
                 for index, (cell, width) in enumerate(zip(row, widths)))
        yield _GAP.join(cells).rstrip()


def estimate_text(estimate: Estimate) -> str:
    """Return the value, or its interval if there is no value."""
    if estimate.value is not None:
        return f"{estimate.value:.2f}"
    return ends_text(estimate.low, estimate.high) or "unknown"


def row_texts(row: Row) -> tuple[str, ...]:
    """Return the cells of a table row: name, both sides, difference, its interval, p-value among all, result."""
    found = row.difference
    return (f"{row.title} {row.word if row.word not in row.title else ''}".rstrip(), estimate_text(row.first),
            estimate_text(row.second), "" if found.value is None else signed_number(found.value, 2),
            "" if found.reason else ends_text(found.low, found.high, signed_number),
            "" if found.reason else chance_text(row.adjusted), row.change.value + (" *" if row.is_different else ""))


def signed_number(value: float, digits: int) -> str:
    """Return a number with its sign, also a plus."""
    return f"{value:+.{digits}f}"


def chance_text(chance: float, number: Number = plain_number) -> str:
    """Return a p-value; small ones have an upper bound instead of zero."""
    return f"< {number(_MIN_CHANCE, 3)}" if chance < _MIN_CHANCE else number(chance, 3)
