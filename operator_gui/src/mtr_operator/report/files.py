"""Report of a finished test as files in a folder."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib
from typing import Callable

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.storage.atomic import write_bytes

from . import budget_json, results_csv
from .assessed import assess

# Maximum characters of an exception's text.
_MAX_SAID = 300
PICTURE_NAME, PAGE_NAME = "protocol.png", "protocol.pdf"
FILE_NAMES = (results_csv.FILE_NAME, budget_json.FILE_NAME, PICTURE_NAME, PAGE_NAME)


def write_report(folder: pathlib.Path, scenario: AnyScenario, parameters: ScenarioParameters,
                 progress: Progress, tell: Callable[[str], None] = logging.warning) -> Assessment:
    """Write results.csv, budget.json and the protocol; return the assessment. OutputError if writing fails.

    tell: receives a sentence for each file that cannot be created; the others are written.
    """
    assessment = assess(scenario, parameters, progress)
    for name, make in report_files(scenario, parameters, progress, assessment).items():
        try:
            content = make()
        except OperatorError as error:
            tell(f"{name} is missing: {error}")
            continue
        # A faulty picture must not lose the results of a test.
        except Exception as error:
            logging.debug("The file %s was not made.", name, exc_info=True)
            tell(f"{name} is missing, because the application has a defect: {type(error).__name__}: "
                 f"{str(error)[:_MAX_SAID]}")
            continue
        write_bytes(folder / name, content)
    return assessment


def report_files(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                 assessment: Assessment) -> dict[str, Callable[[], bytes]]:
    """Return a function that creates the content of each file, by file name."""
    # Importing matplotlib lasts as long as all other imports, and the file names are needed at the start.
    from .protocol_page import protocol_pdf, protocol_png

    return {results_csv.FILE_NAME: lambda: results_csv.results_csv(scenario, progress, assessment).encode("utf-8"),
            budget_json.FILE_NAME: lambda: budget_json.budget_json(progress, assessment).encode("utf-8"),
            PICTURE_NAME: lambda: protocol_png(scenario, parameters, progress, assessment),
            PAGE_NAME: lambda: protocol_pdf(scenario, parameters, progress, assessment)}
