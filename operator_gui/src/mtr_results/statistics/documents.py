"""Spread, capability and trend as plain values for JSON and pages; an open end is null."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.estimation.components import Component, Spread
from mtr_operator.history.estimate import Known
from mtr_operator.history.statistics.documents import Document, finite

from .capability import Capability, Index
from .trend import Trend


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
