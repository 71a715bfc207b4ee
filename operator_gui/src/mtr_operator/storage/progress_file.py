"""Progress files: JSON, written whole after each line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Mapping, NoReturn, Sequence

from mtr_operator.domain.errors import InvalidParameter, OutputError, ProgressFileError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

from .atomic import write_bytes
from .progress_document import progress_from_document

FILE_NAME = "progress.json"
# A test of some hundred lines takes 100 kB; a larger file is something else.
MAX_BYTES = 16 * 1024 * 1024


def save_progress(path: pathlib.Path, progress: Progress) -> None:
    """Write the file; OutputError when it fails."""
    text = json.dumps(progress.to_document(), indent=1, allow_nan=False)
    write_bytes(path, text.encode("utf-8") + b"\n")


def load_progress(path: pathlib.Path, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
    """Progress in a file, to go on with; ProgressFileError says what is wrong with the file."""
    try:
        return progress_from_document(_document(path), scenario, parameters)
    except ProgressFileError as error:
        raise ProgressFileError(f"The test cannot be continued from {path}. {error}") from None


def open_progress(path: pathlib.Path,
                  scenarios: Mapping[str, AnyScenario]) -> tuple[AnyScenario, ScenarioParameters, Progress]:
    """Scenario, parameters and progress in a file; ProgressFileError says what is wrong with the file."""
    try:
        document = _document(path)
        parts = document if isinstance(document, dict) else {}
        name, stored = parts.get("scenario"), parts.get("parameters")
        if not isinstance(name, str) or name not in scenarios or not isinstance(stored, dict):
            raise ProgressFileError("It is not a progress file of this application, or of a scenario that it does not "
                                    "know.")
        parameters = scenarios[name].parameters_type.from_mapping(stored)
        return scenarios[name], parameters, progress_from_document(document, scenarios[name], parameters.to_mapping())
    except (InvalidParameter, ProgressFileError) as error:
        raise ProgressFileError(f"The test cannot be continued from {path}. {error}") from None


def refuse_to_overwrite(path: pathlib.Path, report_names: Sequence[str] = ()) -> None:
    """Raise OutputError when the file, or a report beside it, holds measured lines that a new test would replace."""
    if os.path.lexists(path) and not _is_empty(path):
        raise OutputError(f"The folder {path.parent} holds results of another test; choose another folder, or continue "
                          f"that test with --continue {path}.")
    for name in report_names:
        if os.path.lexists(path.with_name(name)):
            raise OutputError(f"The folder {path.parent} holds {name} of another test; choose another folder.")


def _is_empty(path: pathlib.Path) -> bool:
    try:
        document = _document(path)
    except ProgressFileError:
        return False
    return isinstance(document, dict) and not document.get("results")


def _document(path: pathlib.Path) -> Any:
    try:
        if path.stat().st_size > MAX_BYTES:
            raise ProgressFileError(f"It is larger than {MAX_BYTES // 1024 ** 2} MiB.")
        return json.loads(path.read_text(encoding="utf-8"), parse_constant=_refuse_constant)
    except OSError as error:
        raise ProgressFileError(f"It cannot be read: {error.strerror or error}.") from None
    except (ValueError, RecursionError):
        raise ProgressFileError("It is truncated or not a JSON file.") from None


def _refuse_constant(name: str) -> NoReturn:
    # NaN and infinities are no JSON, and are never written.
    raise ValueError(name)
