"""The document of a progress file: read, and checked piece by piece."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import pathlib
from typing import Any, Callable, Mapping, NoReturn, Sequence, TypeVar

from mtr_operator.domain.errors import (
    InvalidCalibration,
    InvalidIdentity,
    InvalidLimits,
    InvalidParameter,
    ProgressFileError,
)
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.domain.results.document import read_record, shown_text
from mtr_operator.domain.results.frame_record import record_from
from mtr_operator.domain.results.line_result import LineResult, result_from_document
from mtr_operator.domain.results.progress import FORMAT, VERSION, JournalMark, Progress, car_from
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.limits_document import limits_from

from .atomic import checked_size

Given = TypeVar("Given")
# A test of some hundred lines takes 100 kB; a larger file is something else.
MAX_BYTES = 16 * 1024 * 1024
_MAX_SHOWN = 60
DAMAGED = "It is damaged: parts of it are missing or of the wrong kind."


def read_document(path: pathlib.Path) -> Any:
    """Plain values of a JSON file; ProgressFileError when it is none."""
    try:
        if checked_size(path) > MAX_BYTES:
            raise ProgressFileError(f"It is larger than {MAX_BYTES // 1024 ** 2} MiB.")
        return json.loads(path.read_text(encoding="utf-8"), parse_constant=_refuse_constant)
    except OSError as error:
        raise ProgressFileError(f"It cannot be read: {error.strerror or error}.") from None
    except (ValueError, RecursionError):
        raise ProgressFileError("It is truncated or not a JSON file.") from None


def _refuse_constant(name: str) -> NoReturn:
    # NaN and infinities are no JSON, and are never written.
    raise ValueError(name)


def mark_in(document: Any) -> JournalMark | None:
    """How far the journal reached when the document was written; ProgressFileError when that part is damaged."""
    mark = document.get("journal") if isinstance(document, dict) else None
    if mark is None:
        return None
    try:
        return read_record(JournalMark, mark)
    except (KeyError, TypeError, ValueError):
        raise ProgressFileError(DAMAGED) from None


def progress_from_document(document: Any, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
    """Progress of a test with this scenario and these parameters; ProgressFileError says what does not fit."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise ProgressFileError("It is not a progress file of this application.")
    if document.get("version") != VERSION:
        raise ProgressFileError(f"It has version {str(document.get('version'))[:_MAX_SHOWN]}; this application reads "
                                f"version {VERSION}.")
    if document.get("scenario") != scenario.name:
        raise ProgressFileError(f"It belongs to the scenario {str(document.get('scenario'))[:_MAX_SHOWN]}, not to "
                                f"{scenario.name}.")
    _check_parameters(document.get("parameters"), parameters, scenario)
    try:
        progress = Progress(scenario.name, parameters, _session_from(document["session"]),
                            None if document["car"] is None else car_from(document["car"]),
                            _results_from(document["results"], scenario),
                            _numbers_from(document["retried"]),
                            record_from(document.get("frame_record")), mark_in(document),
                            limits=_given(document, "limits", limits_from),
                            calibration=_given(document, "calibration", calibration_from),
                            identity=_given(document, "identity", identity_from),
                            skipped=_numbers_from(document.get("skipped", [])))
        _check_lines(progress, scenario)
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError):
        raise ProgressFileError(DAMAGED) from None
    except (InvalidLimits, InvalidCalibration, InvalidIdentity) as error:
        raise ProgressFileError(f"It is damaged: {error}") from None
    return progress


def _given(document: Mapping[str, Any], name: str, read: Callable[[Any], Given]) -> Given | None:
    """What the Operator gave beside the parameters, None where the file has nothing of it."""
    return read(document[name]) if name in document else None


def _session_from(session: Any) -> dict[str, str]:
    if not isinstance(session, dict) or not all(isinstance(text, str) for text in session.values()):
        raise TypeError("session")
    return {shown_text(name): shown_text(text) for name, text in session.items()}


def _numbers_from(numbers: Any) -> list[int]:
    if not isinstance(numbers, list) or not all(type(number) is int for number in numbers):
        raise TypeError("numbers of the lines")
    return list(numbers)


def _check_parameters(stored: Any, wanted: dict[str, Any], scenario: AnyScenario) -> None:
    if not isinstance(stored, dict):
        raise ProgressFileError("It is damaged: the parameters are missing.")
    # A parameter that came after the file had its default then.
    declared = scenario.parameters_type
    former = {**{item.file_key: item.default for item in declared.declarations().values()},
              **{name: choice.default for name, choice in declared.choices().items()}, **stored}
    # Whether the Car is checked before a test changes no distance.
    for name in sorted((set(former) | set(wanted)) - set(declared.flags())):
        if former.get(name) != wanted.get(name):
            raise ProgressFileError(f"It was measured with other parameters: {name[:_MAX_SHOWN]} was "
                                    f"{_shown(former.get(name))}, now it is {_shown(wanted.get(name))}.")


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return value[:_MAX_SHOWN]
    is_short = value is None or isinstance(value, (bool, float)) or (isinstance(value, int) and abs(value) < 1e15)
    return str(value) if is_short else f"of the kind {type(value).__name__}"


def _results_from(documents: Sequence[Mapping[str, Any]], scenario: AnyScenario) -> list[LineResult]:
    return [result_from_document(scenario.result_type, document) for document in documents]


def _check_lines(progress: Progress, scenario: AnyScenario) -> None:
    numbers = progress.measured()
    if numbers and progress.car is None:
        raise ValueError("results without a Car")
    if numbers != sorted(set(numbers)) or not {*progress.retried, *progress.skipped} <= set(numbers):
        raise ValueError("numbers of the lines")
    if numbers:
        try:
            lines = scenario.lines(scenario.parameters_type.from_mapping(progress.parameters), progress.measured_car)
        except InvalidParameter as error:
            raise ProgressFileError(f"Its Car and its parameters do not fit together. {error}") from None
        if not set(numbers) <= {line.number for line in lines}:
            raise ProgressFileError(f"The progress file holds {scenario.line_word} {max(numbers)}; this test has "
                                    f"{len(lines)}.")
