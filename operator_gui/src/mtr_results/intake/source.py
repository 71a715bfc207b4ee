"""Where tests lie: progress files, folders with them, and bundles, which are tests in one file each."""
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
    """Files of the tests at a path, sorted: the file itself, the test in a folder, or those in the folders within it;
    StoreError when there is none."""
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
    """Context with the progress file of the test in a file; a bundle is verified, then unpacked meanwhile.

    stations: keys of those whose bundles are taken, none for any. StoreError for a bundle that is not as it was signed,
    or signed by another station.
    """
    if not path.name.endswith(BUNDLE_SUFFIX):
        yield path
        return
    with unpacked(path, stations) as folder:
        yield folder / FILE_NAME


def files_of(path: pathlib.Path) -> dict[str, pathlib.Path]:
    """Files of the test with this progress file, by their names: all of its folder when it has one of its own, else
    those that bear its name; photos included. Hidden files, names that are refused (see inside) and links that lead out
    of the folder are left out."""
    record = progress_path(path)
    beside = ([*record.parent.iterdir()] if record.name == FILE_NAME else [record, record.with_suffix(SUFFIX)])
    photos = photo_folder(record)
    of_photos = [*photos.iterdir()] if photos.is_dir() and stays_inside(record.parent, photos) else []
    return {found.relative_to(record.parent).as_posix(): found for found in sorted([*beside, *of_photos])
            if not name_problem(found.name) and stays_inside(found.parent, found) and found.is_file()}
