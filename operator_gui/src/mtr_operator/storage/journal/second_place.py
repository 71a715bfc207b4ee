"""Where a measurement is kept that cannot be written where it belongs: the disk is full, or its folder has gone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import tempfile
from typing import Sequence

import platformdirs

from mtr_operator.domain.errors import OutputError

from .journal_file import JournalFile

FOLDER_NAME = "mtr-operator-kept"


def second_places() -> Sequence[pathlib.Path]:
    """Folders to try, in this order: the system's for what a program leaves behind, and for temporary files."""
    temporary = pathlib.Path(tempfile.gettempdir())
    return platformdirs.user_data_path(FOLDER_NAME, appauthor=False), temporary / FOLDER_NAME


def open_second_place(name: str, content: bytes) -> tuple[JournalFile, pathlib.Path] | None:
    """A journal of this name with this content in the first folder that takes it, and its path; None when none does."""
    for folder in second_places():
        path = folder / name
        file = JournalFile(path)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            file.open(0)
            file.append(content)
        except (OSError, OutputError):
            file.close()
        else:
            return file, path
    return None
