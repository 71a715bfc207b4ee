"""The report of a finished test as files in a folder."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.storage.atomic import write_bytes

from . import protocol_png, results_csv

FILE_NAMES = (results_csv.FILE_NAME, protocol_png.FILE_NAME)


def write_report(folder: pathlib.Path, scenario: AnyScenario, parameters: ScenarioParameters,
                 progress: Progress) -> None:
    """Write results.csv and protocol.png; OutputError when it fails."""
    write_bytes(folder / results_csv.FILE_NAME, results_csv.results_csv(scenario, progress).encode("utf-8"))
    write_bytes(folder / protocol_png.FILE_NAME, protocol_png.protocol_png(scenario, parameters, progress))
