"""Where tests are: each file that may be one, with a stamp that is another one when the file is."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
from typing import Iterator, Sequence

from mtr_operator.storage.journal_file import SUFFIX
from mtr_operator.storage.progress_file import FILE_NAME

# Sizes and times of the progress file and its journal; zeros where one is missing.
Stamp = tuple[int, ...]
_NOTHING = (0, 0)
_RECORD = ".json"


def stamps(folders: Sequence[pathlib.Path]) -> dict[str, Stamp]:
    """Stamp of each test by its path: files of their own in these folders, and one in each folder within them. A folder
    that cannot be read holds none."""
    found: dict[str, Stamp] = {}
    for folder in dict.fromkeys(folders):
        found.update(_of_folder(folder))
    return found


def _of_folder(folder: pathlib.Path) -> Iterator[tuple[str, Stamp]]:
    files: dict[str, tuple[int, int]] = {}
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.startswith("."):
                    continue
                if entry.is_dir():
                    yield from _test(os.path.join(entry.path, FILE_NAME), _stamp(os.path.join(entry.path, FILE_NAME)))
                elif entry.name.endswith((_RECORD, SUFFIX)):
                    files[entry.path] = _stamp(entry.path)
    except OSError:
        # What was seen before counts.
        pass
    for path in files:
        record = path[:-len(SUFFIX)] + _RECORD if path.endswith(SUFFIX) else path
        if path == record or record not in files:
            yield from _test(record, files.get(record, _NOTHING))


def _test(record: str, stamp: tuple[int, int]) -> Iterator[tuple[str, Stamp]]:
    """A test whose record has this stamp, if it is there, or its journal."""
    journal = record[:-len(_RECORD)] + SUFFIX
    of_journal = _stamp(journal)
    if stamp != _NOTHING or of_journal != _NOTHING:
        yield (record if stamp != _NOTHING else journal), (*stamp, *of_journal)


def _stamp(path: str) -> tuple[int, int]:
    try:
        found = os.stat(path)
    except OSError:
        return _NOTHING
    return found.st_mtime_ns, found.st_size
