"""What a row of the store says of a distance, in the words of the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping

from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.report.figures import TEMPLATES, filled


def figure_text(row: Mapping[str, Any]) -> str:
    """Such as "5.21", "at least 6.00", "not reached"."""
    figure = Figure(Kind(row["kind"]), row["first_m"], row["second_m"])
    return filled(TEMPLATES[figure.kind], figure)
