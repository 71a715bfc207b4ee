"""Text of a distance of the store, in the words of the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping

from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.report.figures import TEMPLATES, filled


def figure_text(row: Mapping[str, Any]) -> str:
    """Return a text such as "5.21", "at least 6.00" or "not reached"."""
    figure = Figure(Kind(row["kind"]), row["first_m"], row["second_m"])
    return filled(TEMPLATES[figure.kind], figure)
