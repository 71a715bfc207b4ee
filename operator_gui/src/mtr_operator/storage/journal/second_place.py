"""Where a measurement is kept that cannot be written where it belongs: the disk is full, or its folder has gone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import glob
import itertools
import os
import pathlib
import tempfile
from typing import Iterator, Sequence

import platformdirs

from mtr_operator.domain.errors import OutputError, ProgressFileError
from mtr_operator.domain.results.progress import JournalMark

from .journal_file import SUFFIX, JournalFile, Recovered, read_journal

FOLDER_NAME = "mtr-operator-kept"


def second_places() -> Sequence[pathlib.Path]:
    """Folders to try, in this order: the system's for what a program leaves behind, and for temporary files."""
    temporary = pathlib.Path(tempfile.gettempdir())
    return platformdirs.user_data_path(FOLDER_NAME, appauthor=False), temporary / FOLDER_NAME


def open_second_place(stem: str, mark: JournalMark, content: bytes) -> tuple[JournalFile, pathlib.Path] | None:
    """A new journal with this content in the first folder that takes it, and its path; None when none does.

    What was kept before stays as it is: it may be the only copy until the new one is safe. stem: of the progress file.
    """
    for folder in second_places():
        with contextlib.suppress(OSError, OutputError):
            folder.mkdir(parents=True, exist_ok=True)
            return _made(_free_path(folder, f"{stem}_{mark.id}"), content)
    return None


def kept_journals(test: JournalMark) -> Iterator[tuple[pathlib.Path, Recovered]]:
    """Of a test, all in second places that can be read, with their paths."""
    for folder in second_places():
        for path in sorted(folder.glob(f"*_{glob.escape(test.id)}*{SUFFIX}")):
            with contextlib.suppress(ProgressFileError):
                found = read_journal(path)
                if found.mark is not None and found.mark.id == test.id:
                    yield path, found


def _free_path(folder: pathlib.Path, stem: str) -> pathlib.Path:
    names = itertools.chain([stem], (f"{stem}_{number}" for number in itertools.count(2)))
    return next(free for free in (folder / f"{name}{SUFFIX}" for name in names) if not os.path.lexists(free))


def _made(path: pathlib.Path, content: bytes) -> tuple[JournalFile, pathlib.Path]:
    file = JournalFile(path)
    file.make()
    try:
        file.append(content)
    except OutputError:
        file.close()
        # Half a journal is of no use, and keeps a full disk full.
        with contextlib.suppress(OSError):
            path.unlink()
        raise
    return file, path
