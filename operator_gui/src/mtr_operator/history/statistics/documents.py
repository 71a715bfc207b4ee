"""A comparison as plain values for JSON and pages; an open end is null."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.history.estimate import Estimate
from mtr_operator.history.same_lines import Tests
from mtr_operator.report.figures import TEMPLATES, filled

from .comparison import Comparison
from .row import UNITS, Row

Document = dict[str, Any]


def finite(number: float | None) -> float | None:
    """Return None for a value that is not finite."""
    return number if number is not None and math.isfinite(number) else None


def comparison_document(comparison: Comparison) -> Document:
    """Return all rows, and everything that is not comparable."""
    return {"scenario": comparison.tests.first.scenario.name, "summary": comparison.summary,
            "is_different": comparison.is_different, "rows": [row_document(row) for row in comparison.rows],
            "holes": [{"line": name, "first": first, "second": second} for name, first, second in comparison.holes],
            "differs": [each._asdict() for each in comparison.differing],
            "verdicts": list(comparison.verdicts), "only_first": list(comparison.only_first),
            "only_second": list(comparison.only_second)}


def pair_document(comparison: Comparison) -> Document:
    """Return the comparison of two single tests; `differences` has the distances with the figures of both tests."""
    tests = comparison.tests
    return {**comparison_document(comparison),
            "started": [side.progress.session.get(STARTED, "") for side in tests.sides],
            "differences": [_distance(tests, row) for row in comparison.distances],
            "expected_by_chance": comparison.expected_by_chance}


def _distance(tests: Tests, row: Row) -> Document:
    number = row.lines[0]
    first, second = (filled(TEMPLATES[figure.kind], figure)
                     for figure in (tests.figure(test, number, row.word) for test in (0, 1)))
    found = row.difference
    return {"line": number, "line_second": tests.results[1][number].number, "place": tests.results[0][number].place,
            "what": row.word, "first": first, "second": second, "difference_m": found.value, "low_m": finite(found.low),
            "high_m": finite(found.high), "chance_of_all": row.adjusted, "change": row.change.value,
            "is_different": row.is_different, "reason": found.reason}


def row_document(row: Row) -> Document:
    """Return one quantity of both sets."""
    found = row.difference
    return {"quantity": row.quantity, "unit": UNITS[row.quantity], "line": row.line, "name": row.title,
            "what": row.word, "first": estimate_document(row.first), "second": estimate_document(row.second),
            "difference": found.value, "low": finite(found.low), "high": finite(found.high),
            "chance": found.chance, "chance_of_all": row.adjusted, "change": row.change.value,
            "is_different": row.is_different, "reason": found.reason}


def estimate_document(estimate: Estimate) -> Document:
    """Return value and interval."""
    return {"value": estimate.value, "low": finite(estimate.low), "high": finite(estimate.high),
            "tests": estimate.count, "spread": estimate.spread}
