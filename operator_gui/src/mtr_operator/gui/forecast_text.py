"""What a line is likely to take and to tell, in the language of the window."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.forecast import Forecast

from .i18n import number, translate


def forecast_text(forecast: Forecast | None) -> str:
    """Two short sentences; empty without a forecast."""
    if forecast is None:
        return ""
    few, many = forecast.attempts
    attempts = translate("Forecast", "Attempts on each line: {count}.").format(
        count=str(few) if few == many else _range(str(few), str(many)))
    if forecast.coverage_percent is not None:
        return attempts + " " + translate("Forecast", "Expected 95 % interval of the coverage: {interval} %.").format(
            interval=_interval(forecast.coverage_percent, 0))
    if forecast.interval_m is None:
        return attempts + " " + translate("Forecast", "The distances will have no 95 % interval.")
    return attempts + " " + translate("Forecast", "Expected 95 % interval: {interval} m.").format(
        interval=_interval(forecast.interval_m, 2))


def _interval(halves: tuple[float, float], digits: int) -> str:
    narrow, wide = (f"\N{PLUS-MINUS SIGN}{number(half, digits)}" for half in halves)
    return narrow if narrow == wide else _range(narrow, wide)


def _range(low: str, high: str) -> str:
    return translate("Forecast", "{low} to {high}").format(low=low, high=high)
