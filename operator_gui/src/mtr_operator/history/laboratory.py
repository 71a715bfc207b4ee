"""The store of a laboratory's tests, as far as the application sees it: a package beside it, which need not be there.

The package names its class in the entry point group of this module; nothing of it is imported before that.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import importlib.metadata
import pathlib
import tempfile
from typing import Callable, Iterable, Iterator, Optional, Protocol

from mtr_operator.domain.errors import OperatorError, ProgressFileError
from mtr_operator.storage.progress_file import FILE_NAME

from .entry import TestEntry

GROUP = "mtr_operator.laboratory"
# Stands where a store's own name is not known.
_PROBLEM = "store"


class Laboratory(Protocol):
    """A store that is there. Attributes: where: it is, as it may be shown."""

    where: str

    def entries(self) -> list[TestEntry]:
        """All tests; OperatorError when the store cannot be read. Each has the store's number as its path."""

    def fetch(self, entry: TestEntry, path: pathlib.Path) -> None:
        """Write a test there, with what belongs to it beside it; OperatorError when that fails."""


# None where the package is there, and nobody keeps tests with it.
Opener = Callable[[], Optional[Laboratory]]


def laboratory(points: Iterable[importlib.metadata.EntryPoint] | None = None) -> Laboratory | None:
    """The store of this computer, None without one. points: instead of those that are installed."""
    for point in _installed() if points is None else points:
        try:
            opener: Opener = point.load()
        except ImportError:
            # The application is installed without what its store needs.
            continue
        return opener()
    return None


def _installed() -> Iterable[importlib.metadata.EntryPoint]:
    found = importlib.metadata.entry_points()
    # Python 3.9 hands out a plain dictionary.
    return found.select(group=GROUP) if hasattr(found, "select") else found.get(GROUP, ())


def kept_entries(points: Iterable[importlib.metadata.EntryPoint] | None = None) -> list[TestEntry]:
    """Tests of the store, none without one; one entry with a problem when it cannot be read."""
    try:
        found = laboratory(points)
        return [] if found is None else found.entries()
    except OperatorError as error:
        return [TestEntry(_PROBLEM, str(error))]


@contextlib.contextmanager
def file_of(entry: TestEntry) -> Iterator[pathlib.Path]:
    """Context with the file of a test; of one in a store a copy that lasts as long. OperatorError without one."""
    if not entry.store:
        yield entry.file
        return
    with tempfile.TemporaryDirectory(prefix="mtr_store_") as folder:
        path = pathlib.Path(folder) / FILE_NAME
        fetch(entry, path)
        yield path


def fetch(entry: TestEntry, path: pathlib.Path) -> None:
    """Write a test of the store there, with what belongs to it beside it; OperatorError when that fails."""
    found = laboratory()
    if found is None:
        raise ProgressFileError(f"The store {entry.store} is gone.")
    found.fetch(entry, path)
