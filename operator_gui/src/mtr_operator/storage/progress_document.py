"""The document of a progress file, checked piece by piece."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping, Sequence

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.frame_record import record_from
from mtr_operator.domain.results.line_result import LineResult, result_from_document
from mtr_operator.domain.results.progress import FORMAT, VERSION, Progress, car_from
from mtr_operator.domain.scenario import AnyScenario


def progress_from_document(document: Any, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
    """Progress of a test with this scenario and these parameters; ProgressFileError says what does not fit."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise ProgressFileError("It is not a progress file of this application.")
    if document.get("version") != VERSION:
        raise ProgressFileError(f"It has version {document.get('version')}; this application reads version {VERSION}.")
    if document.get("scenario") != scenario.name:
        raise ProgressFileError(f"It belongs to the scenario {document.get('scenario')}, not to {scenario.name}.")
    _check_parameters(document.get("parameters"), parameters, scenario)
    try:
        progress = Progress(scenario.name, parameters, dict(document["session"]),
                            None if document["car"] is None else car_from(document["car"]),
                            _results_from(document["results"], scenario),
                            [int(number) for number in document["retried"]],
                            record_from(document.get("frame_record")))
        _check_lines(progress)
    except (KeyError, TypeError, ValueError, AttributeError):
        raise ProgressFileError("It is damaged: parts of it are missing or of the wrong kind.") from None
    return progress


def _check_parameters(stored: Any, wanted: dict[str, Any], scenario: AnyScenario) -> None:
    if not isinstance(stored, dict):
        raise ProgressFileError("It is damaged: the parameters are missing.")
    # Whether the Car is checked before a test changes no distance.
    for name in sorted((set(stored) | set(wanted)) - set(scenario.parameters_type.flags())):
        if stored.get(name) != wanted.get(name):
            raise ProgressFileError(f"It was measured with other parameters: {name} was {stored.get(name)}, "
                                    f"now it is {wanted.get(name)}.")


def _results_from(documents: Sequence[Mapping[str, Any]], scenario: AnyScenario) -> list[LineResult]:
    return [result_from_document(scenario.result_type, document) for document in documents]


def _check_lines(progress: Progress) -> None:
    if progress.results and progress.car is None:
        raise ValueError("results without a Car")
    numbers = progress.measured()
    if numbers != sorted(set(numbers)):
        raise ValueError("numbers of the lines")
