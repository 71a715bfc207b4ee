"""Index of the tests in some folders; each file is read once, and unchanged ones come from a cache."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import json
import pathlib
import time
from typing import Callable, Sequence

import platformdirs

from mtr_operator.domain.errors import OutputError
from mtr_operator.storage.atomic import write_bytes

from .entry import TestEntry, entry_from
from .places import Stamp, look
from .reading import read_entry
from .search import listed

FORMAT, VERSION = "mtr-operator history", 2
# Period of progress reports while reading, in s of wall time.
TOLD_PERIOD_S = 0.5
# Size of 100,000 tests; a larger file is not such a cache.
_MAX_BYTES = 128 * 1024 * 1024
_APPLICATION = "mtr-operator"
_Known = dict[str, tuple[Stamp, TestEntry]]


def cache_path(folders: Sequence[pathlib.Path]) -> pathlib.Path:
    """Return the cache file for these folders, in the system's folder for reproducible data."""
    name = hashlib.sha256("\n".join(str(folder.absolute()) for folder in folders).encode("utf-8")).hexdigest()[:16]
    return platformdirs.user_cache_path(_APPLICATION, appauthor=False) / f"history_{name}.json"


class Index:
    """Tests in folders. cache: file, None for no cache.

    Attributes: entries: newest first, one for each test; unreadable ones are at the end. read: number of files that the
    last refresh read.
    """

    def __init__(self, folders: Sequence[pathlib.Path], cache: pathlib.Path | None = None):
        self._folders = tuple(folders)
        self._cache = cache
        self._known: _Known | None = None
        self.entries: list[TestEntry] = []
        self.read = 0

    def refresh(self, tell: Callable[[list[TestEntry]], None] = lambda _: None,
                is_cancelled: Callable[[], bool] = lambda: False) -> list[TestEntry]:
        """Read new and changed files, and return the entries; tell is called with the entries so far."""
        before = self._load() if self._known is None else self._known
        found = look(self._folders)
        there = found.stamps
        out_of_reach = [TestEntry(path, problem) for path, problem in found.problems.items()]
        known: _Known = {path: before[path] for path, stamp in there.items()
                         if path in before and before[path][0] == stamp}
        self.read = 0
        told_s = time.monotonic()
        # The newest are needed first.
        for path in sorted(there.keys() - known.keys(), key=lambda path: there[path], reverse=True):
            if is_cancelled():
                break
            known[path] = there[path], read_entry(pathlib.Path(path))
            self.read += 1
            if time.monotonic() - told_s >= TOLD_PERIOD_S:
                tell(_listed(known, out_of_reach))
                told_s = time.monotonic()
        self._known = known
        if self.read or known.keys() != before.keys():
            self._save(known)
        self.entries = _listed(known, out_of_reach)
        return self.entries

    def _load(self) -> _Known:
        """Return the cached entries; a damaged cache, or one of a different version, counts as empty."""
        known: _Known = {}
        with contextlib.suppress(OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
            if self._cache is not None and self._cache.is_file() and self._cache.stat().st_size <= _MAX_BYTES:
                document = json.loads(self._cache.read_bytes())
                if (document["format"], document["version"]) == (FORMAT, VERSION):
                    for stamp, entry in document["tests"]:
                        found = entry_from(entry)
                        known[found.path] = tuple(int(number) for number in stamp), found
        return known

    def _save(self, known: _Known) -> None:
        if self._cache is None:
            return
        document = {"format": FORMAT, "version": VERSION,
                    "tests": [(stamp, entry.to_document()) for stamp, entry in known.values()]}
        # Without a cache only the next start lasts longer.
        with contextlib.suppress(OSError, OutputError):
            self._cache.parent.mkdir(parents=True, exist_ok=True)
            # ASCII, because names of files may be invalid UTF-8.
            write_bytes(self._cache, json.dumps(document).encode("ascii"))


def _listed(known: _Known, out_of_reach: Sequence[TestEntry]) -> list[TestEntry]:
    return listed([*(entry for _, entry in known.values()), *out_of_reach])
