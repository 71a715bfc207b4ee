"""Writes budget.json: the parts of each distance's uncertainty, and the correlations between the distances."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import json
import math
from typing import Any

from mtr_operator.domain.estimation.budget.distance_budget import DistanceBudget, correlations
from mtr_operator.domain.estimation.budget.terms import Term
from mtr_operator.domain.estimation.interval import LEVEL
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.storage.given_files import calibration_of

FILE_NAME = "budget.json"
# A correlation is accurate to a hundredth at best; a table of sixty distances is still readable.
_DIGITS = 3
_MAX_CORRELATED = 60


def budget_json(progress: Progress, assessment: Assessment) -> str:
    """Return the content of the file. Infinite degrees of freedom are null."""
    budgets = assessment.budgets
    document = {
        "format": "mtr-operator budget", "version": 1,
        "calibration": calibration_of(progress).to_document(),
        "coverage": LEVEL,
        "distances": [_entry(budget) for budget in budgets],
        "correlations": {"of": [f"{budget.line} {budget.word}" for budget in budgets[:_MAX_CORRELATED]],
                         "matrix": [[round(value, _DIGITS) for value in row]
                                    for row in correlations(budgets[:_MAX_CORRELATED])]}}
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def _entry(budget: DistanceBudget) -> dict[str, Any]:
    return {"line": budget.line, "word": budget.word, "distance_m": budget.distance_m,
            "own_sigma_m": budget.own_sigma_m, "common_sigma_m": budget.common_sigma_m, "sigma_m": budget.sigma_m,
            "degrees_of_freedom": _finite(budget.degrees_of_freedom), "coverage_factor": budget.coverage_factor,
            "expanded_m": budget.expanded_m, "terms": [_term(term) for term in budget.terms]}


def _term(term: Term) -> dict[str, Any]:
    values = {**dataclasses.asdict(term), "distribution": term.distribution.value,
              "degrees_of_freedom": _finite(term.degrees_of_freedom), "contribution_m": term.contribution_m}
    return values


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
