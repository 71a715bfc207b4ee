"""What a line is likely to take and to tell, in the language of the window."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.prospect import Prospect

from .i18n import number, translate


def prospect_text(prospect: Prospect | None) -> str:
    """Two short sentences; empty without a prospect."""
    if prospect is None:
        return ""
    few, many = prospect.attempts
    attempts = translate("Prospect", "Attempts on each line: {count}.").format(
        count=str(few) if few == many else _range(str(few), str(many)))
    if prospect.coverage_percent is not None:
        return attempts + " " + translate("Prospect", "Expected 95 % interval of the coverage: {interval} %.").format(
            interval=_interval(prospect.coverage_percent, 0))
    if prospect.interval_m is None:
        return attempts + " " + translate("Prospect", "The distances will have no 95 % interval.")
    return attempts + " " + translate("Prospect", "Expected 95 % interval: {interval} m.").format(
        interval=_interval(prospect.interval_m, 2))


def _interval(halves: tuple[float, float], digits: int) -> str:
    narrow, wide = (f"\N{PLUS-MINUS SIGN}{number(half, digits)}" for half in halves)
    return narrow if narrow == wide else _range(narrow, wide)


def _range(low: str, high: str) -> str:
    return translate("Prospect", "{low} to {high}").format(low=low, high=high)
