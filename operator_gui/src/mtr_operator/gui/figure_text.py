"""Distances in the language of the window; words, units and digits are those of report/figures.py."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.line_result import LineResult, MeasuredDistance
from mtr_operator.history.estimate import Estimate
from mtr_operator.report import figures

from .i18n import number, translate

_WORDS = (Kind.NOT_REACHED, Kind.INVALID, Kind.UNKNOWN)


def cell_text(figure: Figure, sigma_m: float | None = None) -> str:
    """In a table whose heading has the unit."""
    return figures.filled(_translated(figures.TEMPLATES[figure.kind]), figure, number, sigma_m)


def figure_text(figure: Figure, sigma_m: float | None = None) -> str:
    """With its unit."""
    text = cell_text(figure, sigma_m)
    return text if figure.kind in _WORDS else f"{text} m"


def sign_text(figure: Figure) -> str:
    """Beside a point of a picture."""
    return figures.filled(figures.SIGNS[figure.kind], figure, number)


def sigma_text(sigma_m: float | None) -> str:
    """In a table whose heading has the unit."""
    return figures.sigma_text(sigma_m, number)


def sigma_heading(results: Sequence[LineResult]) -> str:
    """Of the uncertainties, with their unit."""
    return f"{figures.sigma_word(results, _translated)} [m]"


def interval_text(distance: MeasuredDistance) -> str:
    """Ends of the 95 % interval, or the one that is known."""
    return figures.interval_text(distance, number, _translated)


def ends_text(low_m: float, high_m: float, digits: int = 2) -> str:
    """Of an interval whose ends may be infinite; empty without any."""
    return figures.ends_text(low_m, high_m, number, _translated, digits)


def difference_text(value: float | None, low: float, high: float) -> tuple[str, str]:
    """Return a difference and its interval with their signs; empty texts if they are unknown."""
    return "" if value is None else _signed(value, 2), figures.ends_text(low, high, _signed, _translated)


def estimate_text(estimate: Estimate) -> str:
    """Return the value of an estimate, or its known ends without one."""
    if estimate.value is not None:
        return number(estimate.value, 2)
    return ends_text(estimate.low, estimate.high) or _translated("unknown")


def _signed(value: float, digits: int) -> str:
    """Return a number with its sign, also a plus."""
    return ("+" if value >= 0.0 else "\N{MINUS SIGN}") + number(abs(value), digits)


def _translated(text: str) -> str:
    return translate("Figure", text)
