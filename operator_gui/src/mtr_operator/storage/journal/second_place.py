"""Where a measurement is kept that cannot be written where it belongs: the disk is full, or its folder has gone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import glob
import itertools
import os
import pathlib
import stat
import tempfile
from typing import Iterator, Sequence

import platformdirs

from mtr_operator.domain.errors import OutputError, ProgressFileError
from mtr_operator.domain.results.progress import JournalMark

from .journal_file import SUFFIX, JournalFile, Recovered, read_journal

FOLDER_NAME = "mtr-operator-kept"
_PRIVATE = 0o700
_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


def second_places() -> Sequence[pathlib.Path]:
    """Folders to write to, in this order: the system's for a person's data, and for what lives as long as a session."""
    return (platformdirs.user_data_path(FOLDER_NAME, appauthor=False),
            platformdirs.user_runtime_path(FOLDER_NAME, appauthor=False))


def open_second_place(stem: str, mark: JournalMark, content: bytes) -> tuple[JournalFile, pathlib.Path] | None:
    """A new journal with this content in the first folder that takes it, and its path; None when none does.

    What was kept before stays as it is: it may be the only copy until the new one is safe. stem: of the progress file.
    """
    for folder in second_places():
        with contextlib.suppress(OSError, OutputError):
            folder.mkdir(parents=True, exist_ok=True, mode=_PRIVATE)
            if privacy_problem(folder):
                # Only the owner may; it fails for a folder of somebody else.
                folder.chmod(_PRIVATE)
            if not privacy_problem(folder):
                return _made(_free_path(folder, f"{stem}_{mark.id}"), content)
    return None


def kept_journals(test: JournalMark) -> Iterator[tuple[pathlib.Path, Recovered]]:
    """Of a test, all in second places that can be read, with their paths. What another user of the computer may have
    written is left out, see distrusted()."""
    for path in _candidates(test):
        with contextlib.suppress(ProgressFileError):
            found = None if _problem(path) else read_journal(path)
            if found is not None and found.mark is not None and found.mark.id == test.id:
                yield path, found


def distrusted(test: JournalMark) -> Iterator[str]:
    """Sentences on journals of a test that are not used, because another user may have written them."""
    for path in _candidates(test):
        problem = _problem(path)
        if problem:
            yield f"{path} is not used: {problem}."


def privacy_problem(path: pathlib.Path) -> str:
    """Reason why another user of the computer may have written a file or folder; empty when only its owner can."""
    if os.name != "posix":
        # Windows keeps these folders in the user's profile.
        return ""
    try:
        found = path.lstat()
    except OSError as error:
        return error.strerror or str(error)
    if stat.S_ISLNK(found.st_mode):
        return "it is a link"
    if found.st_uid != os.geteuid():
        return "it belongs to another user"
    return "other users may write it" if found.st_mode & _BY_OTHERS else ""


def _candidates(test: JournalMark) -> Iterator[pathlib.Path]:
    # Earlier versions wrote to the folder of temporary files.
    for folder in (*second_places(), pathlib.Path(tempfile.gettempdir()) / FOLDER_NAME):
        with contextlib.suppress(OSError):
            yield from sorted(folder.glob(f"*_{glob.escape(test.id)}*{SUFFIX}"))


def _problem(path: pathlib.Path) -> str:
    # In a folder that others cannot write, nobody replaces the file after it was checked.
    return privacy_problem(path.parent) or privacy_problem(path)


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
