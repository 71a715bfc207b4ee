"""Sources of tests: progress files, folders with them, and bundles, each of which is a test in one file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
from typing import Collection, Iterator

from mtr_operator.domain.identity.file_name import name_problem
from mtr_operator.history.places import stamps
from mtr_operator.storage.inside import stays_inside
from mtr_operator.storage.journal.journal_file import SUFFIX
from mtr_operator.storage.photos import photo_folder
from mtr_operator.storage.progress_file import FILE_NAME
from mtr_operator.storage.recovery import progress_path

from ..errors import StoreError
from .bundle import unpacked

BUNDLE_SUFFIX = ".mtr.zip"


def tests_in(path: pathlib.Path) -> list[pathlib.Path]:
    """Return the sorted files of the tests at a path: the file itself, the test in a folder, or the tests in its
    subfolders.

    Raises StoreError if there is none.
    """
    if not path.is_dir():
        if not path.exists():
            raise StoreError(f"There is no {path}; name a progress file, a bundle or a folder with tests.")
        return [path]
    own = path / FILE_NAME
    if own.exists() or own.with_suffix(SUFFIX).exists():
        return [own if own.exists() else own.with_suffix(SUFFIX)]
    found = sorted([*map(pathlib.Path, stamps([path])), *path.glob(f"*{BUNDLE_SUFFIX}")])
    if not found:
        raise StoreError(f"The folder {path} holds no test: neither {FILE_NAME} nor folders with one.")
    return found


@contextlib.contextmanager
def opened(path: pathlib.Path, stations: Collection[str] = ()) -> Iterator[pathlib.Path]:
    """Context with the progress file of a test; a bundle is verified and unpacked for the duration of the context.

    stations: keys of the stations whose bundles are accepted; empty accepts all. Raises StoreError if the signature of
    a bundle is not valid or belongs to another station.
    """
    if not path.name.endswith(BUNDLE_SUFFIX):
        yield path
        return
    with unpacked(path, stations) as folder:
        yield folder / FILE_NAME


def files_of(path: pathlib.Path) -> dict[str, pathlib.Path]:
    """Return the files of the test with this progress file by name, including photos.

    A test in its own folder has all files of that folder, any other test the files that share its name. Hidden files,
    rejected names (see inside) and links out of the folder are excluded.
    """
    record = progress_path(path)
    beside = ([*record.parent.iterdir()] if record.name == FILE_NAME else [record, record.with_suffix(SUFFIX)])
    photos = photo_folder(record)
    of_photos = [*photos.iterdir()] if photos.is_dir() and stays_inside(record.parent, photos) else []
    return {found.relative_to(record.parent).as_posix(): found for found in sorted([*beside, *of_photos])
            if not name_problem(found.name) and stays_inside(found.parent, found) and found.is_file()}
