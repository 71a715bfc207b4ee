"""Checks of the application's files: settings, folders, the laboratory's file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Iterator

from mtr_operator.domain.errors import InvalidIdentity, OutputError
from mtr_operator.station.checks.finding import State
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.storage.atomic import output_folder
from mtr_operator.storage.identity_file import load_laboratory

from .finding import Finding


def file_findings(store: SettingsStore) -> Iterator[Finding]:
    """Yield the findings. store: settings, not loaded yet."""
    store.load()
    yield Finding("settings", State.BAD if store.problem else State.GOOD, store.problem or "They can be read.")
    for what, folder in (("results", store.settings.result_folder), ("progress", store.settings.progress_folder)):
        yield _folder(what, folder)
    try:
        required = load_laboratory(store.laboratory_path).required
    except InvalidIdentity as error:
        yield Finding("laboratory", State.BAD, f"No test can start. {error}")
    else:
        wanted = ", ".join(required) or "nothing"
        yield Finding("laboratory", State.GOOD, f"Required of each test is {wanted} ({store.laboratory_path}).")


def _folder(what: str, folder: pathlib.Path) -> Finding:
    try:
        with output_folder(folder):
            # Only an empty folder, as after a failed test, is removed.
            raise _TriedOut
    except _TriedOut:
        return Finding(f"folder of {what}", State.GOOD, f"{folder} can be written.")
    except OutputError as error:
        return Finding(f"folder of {what}", State.BAD, str(error))


class _TriedOut(Exception):
    """Ends the trial of a folder."""
