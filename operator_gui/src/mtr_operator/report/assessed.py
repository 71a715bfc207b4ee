"""Assessment of a test for its report, in addition to the values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment, Assessor
from mtr_operator.storage.given_files import calibration_of


def assess(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress) -> Assessment:
    """Return budgets and verdicts; the progress must contain the Car's dimensions."""
    return Assessor(scenario, parameters, progress.measured_car, calibration_of(progress)).assess(progress)
