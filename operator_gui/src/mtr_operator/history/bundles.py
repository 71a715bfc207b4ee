"""Tests in bundles: verified, then read from a copy."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
import shutil
import tempfile
import zipfile
from typing import Iterator

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.evidence.container import SUFFIX
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.progress_document import MAX_BYTES
from mtr_operator.storage.progress_file import FILE_NAME


def is_bundle(path: pathlib.Path) -> bool:
    """Return True for a bundle, by its name."""
    return path.name.endswith(SUFFIX)


@contextlib.contextmanager
def progress_file_of(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """Context with the progress file of a test: the path itself, or a temporary copy of a bundle.

    ProgressFileError, also for a fault of the copy, names the bundle.
    """
    if not is_bundle(path):
        yield path
        return
    _verify(path)
    with tempfile.TemporaryDirectory(prefix="mtr_bundle_") as folder:
        try:
            yield _copied(path, pathlib.Path(folder))
        except ProgressFileError as error:
            raise ProgressFileError(str(error).replace(folder, str(path))) from None


def _verify(path: pathlib.Path) -> None:
    # The import needs a package that only bundles need.
    from mtr_operator.evidence.verification import is_newer, verify_bundle
    if not path.is_file():
        raise ProgressFileError(f"{path} is no file.")
    found = verify_bundle(path)
    if found.manifest is None and is_newer(path):
        raise ProgressFileError(f"The bundle {path} was written by a newer version of the application.")
    if not found.is_intact:
        raise ProgressFileError(f"The bundle {path} is not as it was signed. {found.problems[0]}")


def _copied(path: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    try:
        with zipfile.ZipFile(path) as container:
            sizes = {info.filename: info.file_size for info in container.infolist()}
            # A progress file with its own name gives it to the bundle, too.
            record = next((name for name in (FILE_NAME, path.name[:-len(SUFFIX)] + ".json") if name in sizes), "")
            if not record:
                raise ProgressFileError(f"The bundle {path} holds no {FILE_NAME}.")
            for name in (record, journal_path(pathlib.Path(record)).name):
                if sizes.get(name, MAX_BYTES + 1) <= MAX_BYTES:
                    with container.open(name) as source, open(folder / name, "wb") as copy:
                        shutil.copyfileobj(source, copy)
    except (OSError, zipfile.BadZipFile) as error:
        raise ProgressFileError(f"The bundle {path} cannot be unpacked: {error}.") from None
    return folder / record
