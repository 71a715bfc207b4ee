"""Interface to the store of a laboratory's tests, which is a separate, optional package.

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
# Placeholder for an unknown name of the store.
_PROBLEM = "store"


class Laboratory(Protocol):
    """Available store. Attributes: where: its location, as shown to people."""

    where: str

    def entries(self) -> list[TestEntry]:
        """Return all tests; OperatorError if the store cannot be read. Each has the store's number as its path."""

    def fetch(self, entry: TestEntry, path: pathlib.Path) -> None:
        """Write a test to this path, with its files next to it; OperatorError if that fails."""


# Result None: the package is installed, but not in use.
Opener = Callable[[], Optional[Laboratory]]


def laboratory(points: Iterable[importlib.metadata.EntryPoint] | None = None) -> Laboratory | None:
    """Return the store of this computer, None without one. points: replace the installed ones."""
    for point in _installed() if points is None else points:
        try:
            opener: Opener = point.load()
        except ImportError:
            # The application is installed without the packages that its store needs.
            continue
        return opener()
    return None


def _installed() -> Iterable[importlib.metadata.EntryPoint]:
    found = importlib.metadata.entry_points()
    # Python 3.9 returns a plain dictionary.
    return found.select(group=GROUP) if hasattr(found, "select") else found.get(GROUP, ())


def kept_entries(points: Iterable[importlib.metadata.EntryPoint] | None = None) -> list[TestEntry]:
    """Return the tests of the store, empty without one; one entry with a problem if it cannot be read."""
    try:
        found = laboratory(points)
        return [] if found is None else found.entries()
    except OperatorError as error:
        return [TestEntry(_PROBLEM, str(error))]


@contextlib.contextmanager
def file_of(entry: TestEntry) -> Iterator[pathlib.Path]:
    """Context with the file of a test; for a test in a store a temporary copy. OperatorError without a store."""
    if not entry.store:
        yield entry.file
        return
    with tempfile.TemporaryDirectory(prefix="mtr_store_") as folder:
        path = pathlib.Path(folder) / FILE_NAME
        fetch(entry, path)
        yield path


def fetch(entry: TestEntry, path: pathlib.Path) -> None:
    """Write a test of the store to this path, with its files next to it; OperatorError if that fails."""
    found = laboratory()
    if found is None:
        raise ProgressFileError(f"The store {entry.store} is gone.")
    found.fetch(entry, path)
