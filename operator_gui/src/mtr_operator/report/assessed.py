"""What a report says of a test beside its values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment, Assessor
from mtr_operator.storage.given_files import calibration_of


def assess(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress) -> Assessment:
    """Budgets and verdicts; the progress has to hold the Car's dimensions."""
    return Assessor(scenario, parameters, progress.measured_car, calibration_of(progress)).assess(progress)
