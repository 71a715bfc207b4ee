"""Content of the panel next to the drawing of a protocol: names and values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
from typing import Any, Tuple

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.parameters import Declaration
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment

from .parameter_names import parameter_name
from .verdict_text import verdict_counts

LARGEST_UNCERTAINTY = "largest uncertainty (95 %)"
Row = Tuple[str, str]


def date_text(started: str) -> str:
    """Return local date and time of the test with its offset from UTC."""
    try:
        moment = datetime.datetime.fromisoformat(started)
    except ValueError:
        return started
    zone = moment.strftime("%z")
    return moment.strftime("%Y-%m-%d  %H:%M") + (f"  (UTC{zone[:3]}:{zone[3:]})" if zone else "")


def summary_rows(scenario: AnyScenario, progress: Progress) -> list[Row]:
    """Return the number of lines per status, and their common result."""
    rows = [("lines", str(len(progress.results)))]
    for index, word in enumerate(scenario.distance_words):
        states = [result.distances[index].status for result in progress.results]
        counts = [(status, states.count(status)) for status in LineStatus]
        text = ", ".join(f"{count} {status.value.replace('_', ' ')}" for status, count in counts if count)
        rows.append((word, text or "nothing measured"))
    return [*rows, *part(scenario, Concluding).summary(progress.results)]


def finding_rows(progress: Progress) -> list[Row]:
    """Return the findings of lines in addition to their distances."""
    return [(result.place, finding) for result in progress.results for finding in result.findings]


def assessment_rows(assessment: Assessment | None) -> list[Row]:
    """Return the largest expanded uncertainty, and the verdict if there are limits."""
    if assessment is None:
        return []
    expanded_m = max((budget.expanded_m for budget in assessment.budgets), default=None)
    rows = [] if expanded_m is None else [(LARGEST_UNCERTAINTY, f"{expanded_m:.3f} m")]
    judgement = assessment.judgement
    if judgement is not None:
        rows += [("verdict", judgement.verdict.word), ("judged lines", verdict_counts(judgement))]
    return rows


def parameter_rows(scenario: AnyScenario, progress: Progress) -> list[Row]:
    """Return all parameters that were set, as shown to people."""
    rows = [(name, str(progress.parameters.get(name, choice.default)))
            for name, choice in scenario.parameters_type.choices().items()]
    return rows + [(parameter_name(name, declared), declared.shown_text(value))
                   for name, declared, value in numbers_with_effect(scenario, progress) if value is not None]


def numbers_with_effect(scenario: AnyScenario, progress: Progress) -> list[tuple[str, Declaration, Any]]:
    """Return field name, declaration and value in the file's unit of each number with an effect in this test."""
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    return [(name, declared, progress.parameters.get(declared.file_key, declared.default))
            for name, declared in parameters.declarations().items() if parameters.has_effect(declared)]


def session_rows(progress: Progress) -> list[Row]:
    """Return the Car and the equipment of the test."""
    car = progress.measured_car
    rows = [("Car measured", f"{car.length:.2f} m \N{MULTIPLICATION SIGN} {car.width:.2f} m")]
    for name in ("car profile", "robot", "software", "robot software"):
        value = str(progress.session.get(name, ""))
        if value:
            rows.append((name, value if len(value) <= 34 else "\N{HORIZONTAL ELLIPSIS}" + value[-33:]))
    return rows
