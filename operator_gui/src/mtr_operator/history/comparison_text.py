"""A comparison as text, and as plain values for another program."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Iterator

from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.report.figures import TEMPLATES, filled
from mtr_operator.report.table import line_name

from .circumstances import circumstances
from .comparison import Comparison, Difference

MEANING = ("A distance is called farther or nearer in the second test only where the whole 95 % interval of its "
           "difference is on that side of zero.")
HEADINGS = ("first m", "second m", "second - first m", "95 % m", "")
_GAP = "  "
_WORDS = (0, 5)


def comparison_lines(comparison: Comparison) -> Iterator[str]:
    """What differs beside the distances, a table of the differences, and what they mean."""
    for number, side in enumerate((comparison.first, comparison.second), start=1):
        yield f"Test {number}: {side.scenario.title} of {side.progress.session.get(STARTED, 'an unknown day')}"
    for other in circumstances(comparison.first, comparison.second):
        yield f"  {other.name}: {other.first or 'nothing'} / {other.second or 'nothing'}"
    rows = [["", *HEADINGS], *(_row(comparison, difference) for difference in comparison.differences)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = (cell.ljust(width) if index in _WORDS else cell.rjust(width)
                 for index, (cell, width) in enumerate(zip(row, widths)))
        yield _GAP.join(cells).rstrip()
    for number, names in ((1, comparison.only_first), (2, comparison.only_second)):
        if names:
            yield f"Only in test {number}: {', '.join(names)}"
    yield MEANING
    yield summary(comparison)


def summary(comparison: Comparison) -> str:
    """Such as "2 farther, 14 no difference shown; by chance alone about 0.8 would differ."."""
    counts = ", ".join(f"{count} {change.value}" for change, count in comparison.counts().items())
    return f"{counts or 'no line in common'}; by chance alone about {comparison.expected_by_chance:.1f} would differ."


def interval_text(low_m: float, high_m: float) -> str:
    """Ends with their signs, or the one that is known; empty without."""
    if math.isfinite(low_m) and math.isfinite(high_m):
        return f"{low_m:+.2f} to {high_m:+.2f}"
    if math.isfinite(low_m):
        return f"at least {low_m:+.2f}"
    return f"at most {high_m:+.2f}" if math.isfinite(high_m) else ""


def comparison_document(comparison: Comparison) -> dict[str, Any]:
    """Plain values; null where an end is not known."""
    return {
        "scenario": comparison.first.scenario.name,
        "started": [side.progress.session.get(STARTED, "") for side in (comparison.first, comparison.second)],
        "differs": [row._asdict() for row in circumstances(comparison.first, comparison.second)],
        "differences": [_values(difference) for difference in comparison.differences],
        "only_first": list(comparison.only_first), "only_second": list(comparison.only_second),
        "expected_by_chance": comparison.expected_by_chance}


def _row(comparison: Comparison, difference: Difference) -> list[str]:
    figures = [filled(TEMPLATES[figure.kind], figure) for figure in (difference.first, difference.second)]
    value = "" if difference.value_m is None else f"{difference.value_m:+.2f}"
    interval = "" if difference.reason else interval_text(difference.low_m, difference.high_m)
    name = line_name(comparison.first.scenario, difference.pair.first)
    return [f"{name} {difference.word}", *figures, value, interval, difference.change.value]


def _values(difference: Difference) -> dict[str, Any]:
    ends = {name: end if math.isfinite(end) else None for name, end in (("low_m", difference.low_m),
                                                                       ("high_m", difference.high_m))}
    return {"line": difference.pair.number, "line_second": difference.pair.second.number,
            "place": difference.pair.first.place, "what": difference.word,
            "first": filled(TEMPLATES[difference.first.kind], difference.first),
            "second": filled(TEMPLATES[difference.second.kind], difference.second),
            "difference_m": difference.value_m, **ends, "change": difference.change.value, "reason": difference.reason}
