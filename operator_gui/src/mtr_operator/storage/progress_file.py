"""Progress files: JSON, written whole after each line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import json
import os
import pathlib
from typing import Any, Mapping, Sequence

from mtr_operator.domain.errors import InvalidParameter, OperatorError, OutputError, ProgressFileError
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

from .atomic import write_bytes
from .journal.journal_file import journal_of, journal_path
from .progress_document import mark_in, read_document
from .recovery import Recovery, progress_path

FILE_NAME = "progress.json"


def progress_content(progress: Progress) -> bytes:
    """Of the file."""
    return json.dumps(progress.to_document(), indent=1, allow_nan=False).encode("utf-8") + b"\n"


def save_progress(path: pathlib.Path, progress: Progress) -> None:
    """Write the file; OutputError when it fails."""
    write_bytes(path, progress_content(progress))


def load_progress(path: pathlib.Path, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
    """Progress in a file and its journal, to go on with; ProgressFileError says what is wrong with the files."""
    try:
        return Recovery(path, to_go_on=True).progress(scenario, parameters)
    except ProgressFileError as error:
        raise _refused(path, error) from None


def open_progress(path: pathlib.Path, scenarios: Mapping[str, AnyScenario], *,
                  to_go_on: bool = False) -> tuple[AnyScenario, ScenarioParameters, Progress]:
    """Scenario, parameters and progress in a file and its journal; ProgressFileError says what is wrong with them.

    to_go_on: see Recovery.
    """
    try:
        recovery = Recovery(path, to_go_on)
        name, stored = recovery.document.get("scenario"), recovery.document.get("parameters")
        if not isinstance(name, str) or name not in scenarios or not isinstance(stored, dict):
            raise ProgressFileError("It is not a progress file of this application, or of a scenario that it does not "
                                    "know.")
        parameters = scenarios[name].parameters_type.from_mapping(stored)
        return scenarios[name], parameters, recovery.progress(scenarios[name], parameters.to_mapping())
    except (InvalidParameter, ProgressFileError) as error:
        raise _refused(path, error) from None


def _refused(path: pathlib.Path, error: OperatorError) -> ProgressFileError:
    return ProgressFileError(f"The test cannot be continued from {path}. {error}")


def journal_mark(path: pathlib.Path) -> JournalMark | None:
    """How far the journal reached when this progress file was written; None without file or journal."""
    try:
        return mark_in(read_document(path))
    except ProgressFileError:
        return None


def is_same_test(continued: pathlib.Path, path: pathlib.Path) -> bool:
    """True when a file that a person names, of either kind, belongs to the test with this progress file."""
    return progress_path(continued).resolve() == path.resolve()


def holds_no_other(path: pathlib.Path, progress: Progress) -> bool:
    """True when no file is there, or one of this test."""
    if not os.path.lexists(path):
        return True
    try:
        document = read_document(path)
    except ProgressFileError:
        return False
    if not isinstance(document, dict):
        return False
    mark = document.get("journal")
    if progress.kept is not None and isinstance(mark, dict) and mark.get("id") != progress.kept.id:
        return False
    session = document.get("session")
    return (isinstance(session, dict) and document.get("scenario") == progress.scenario
            and session.get(STARTED) == progress.session.get(STARTED))


def free_path(path: pathlib.Path) -> pathlib.Path:
    """The path, or one with a number where there is a test already: its name is as fine as a second."""
    others = (path.with_stem(f"{path.stem}_{number}") for number in itertools.count(2))
    return next(free for free in itertools.chain([path], others)
                if not os.path.lexists(free) and not os.path.lexists(journal_path(free)))


def refuse_to_overwrite(path: pathlib.Path, report_names: Sequence[str] = ()) -> None:
    """Raise OutputError when the file, or a report beside it, holds measured lines that a new test would replace."""
    if not _is_empty(path) or not _is_empty_journal(path):
        raise OutputError(f"The folder {path.parent} holds results of another test; choose another folder, or continue "
                          f"that test with --continue {path}.")
    for name in report_names:
        if os.path.lexists(path.with_name(name)):
            raise OutputError(f"The folder {path.parent} holds {name} of another test; choose another folder.")


def _is_empty(path: pathlib.Path) -> bool:
    if not os.path.lexists(path):
        return True
    try:
        document = read_document(path)
    except ProgressFileError:
        return False
    return isinstance(document, dict) and not document.get("results")


def _is_empty_journal(path: pathlib.Path) -> bool:
    try:
        recovered = journal_of(path)
    except ProgressFileError:
        return False
    # Damage before the first finding may have taken what came after it.
    return not recovered.holds_findings and (recovered.is_torn or not recovered.is_damaged)
