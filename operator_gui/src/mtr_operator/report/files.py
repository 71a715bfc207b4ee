"""The report of a finished test as files in a folder."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.storage.atomic import write_bytes

from . import budget_json, results_csv
from .assessed import assess

PICTURE_NAME, PAGE_NAME = "protocol.png", "protocol.pdf"
FILE_NAMES = (results_csv.FILE_NAME, budget_json.FILE_NAME, PICTURE_NAME, PAGE_NAME)


def write_report(folder: pathlib.Path, scenario: AnyScenario, parameters: ScenarioParameters,
                 progress: Progress) -> Assessment:
    """Write results.csv, budget.json and the protocol; OutputError when it fails. What the report says of the test."""
    # Matplotlib takes as long to import as all else together, and this file's names are needed at the start.
    from .protocol_page import protocol_pdf, protocol_png

    assessment = assess(scenario, parameters, progress)
    write_bytes(folder / results_csv.FILE_NAME, results_csv.results_csv(scenario, progress, assessment).encode("utf-8"))
    write_bytes(folder / budget_json.FILE_NAME, budget_json.budget_json(progress, assessment).encode("utf-8"))
    write_bytes(folder / PICTURE_NAME, protocol_png(scenario, parameters, progress, assessment))
    write_bytes(folder / PAGE_NAME, protocol_pdf(scenario, parameters, progress, assessment))
    return assessment
