"""Results as plain values for JSON and pages; an open end is null."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

from mtr_operator.domain.estimation.components import Component, Spread
from mtr_operator.history.estimate import Estimate, Known

from .capability import Capability, Index
from .comparison import UNITS, Comparison, Row
from .trend import Trend

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


def row_document(row: Row) -> Document:
    """Return one quantity of both sets."""
    return {"quantity": row.quantity, "unit": UNITS[row.quantity], "line": row.line, "name": row.name, "what": row.word,
            "first": estimate_document(row.first), "second": estimate_document(row.second),
            "difference": row.change.value, "low": finite(row.change.low), "high": finite(row.change.high),
            "chance": row.change.chance, "chance_of_all": row.adjusted, "change": row.verdict,
            "is_different": row.is_different, "reason": row.change.reason}


def estimate_document(estimate: Estimate) -> Document:
    """Return value and interval."""
    return {"value": estimate.value, "low": finite(estimate.low), "high": finite(estimate.high),
            "tests": estimate.count, "spread": estimate.spread}


def spread_document(spread: Spread) -> Document:
    """Return the components with their intervals."""
    return {"tests": spread.count, "mean_m": finite(spread.mean), "reason": spread.reason,
            "components": [_component(component) for component in spread.components],
            "repeatability_m": finite(spread.repeatability), "reproducibility_m": finite(spread.reproducibility),
            "left_out": list(spread.left_out)}


def capability_document(found: Capability | None) -> Document:
    """Return both indices, or an empty document if they are unknown."""
    if found is None:
        return {}
    return {"cpk": _index(found.within), "ppk": _index(found.overall)}


def _index(index: Index) -> Document:
    return {"value": index.value, "low": finite(index.low), "high": finite(index.high)}


def _component(component: Component) -> Document:
    return {"factor": component.factor, "levels": component.levels, "sigma_m": component.sigma,
            "low_m": component.low, "high_m": finite(component.high)}


def trend_document(trend: Trend) -> Document:
    """Return the points in their order, and the limits."""
    return {"centre_m": finite(trend.centre), "low_m": finite(trend.low), "high_m": finite(trend.high),
            "reason": trend.reason, "unlike": trend.unlike,
            "points": [{**_known(point.known), "is_beyond": point.is_beyond} for point in trend.points]}


def _known(known: Known | None) -> Document:
    if known is None:
        return {"value_m": None, "low_m": None, "high_m": None}
    low, high = (known.low, known.high) if known.ends is None else known.ends
    return {"value_m": known.value, "low_m": finite(low), "high_m": finite(high)}
