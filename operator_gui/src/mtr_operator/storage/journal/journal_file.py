"""The journal of a test on disk: one entry a line, only ever appended to, each line with a number and a check sum.

    {"seq": 12, "kind": "point", "values": {...}, "crc": "1a2b3c4d"}

crc is CRC-32 of the line as it is without it. A line that is cut off, changed or out of order ends what can be
recovered; an entry of kind BEGUN holds the whole progress, so that the numbers may leap before it.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import os
import pathlib
import zlib
from dataclasses import dataclass
from typing import Any, Mapping, NoReturn, Sequence

from mtr_operator.domain.errors import OutputError, ProgressFileError
from mtr_operator.domain.results.journal import BEGUN, LINE, POINT
from mtr_operator.domain.results.progress import JournalMark

from ..atomic import checked_size, sync_folder

FORMAT = "mtr-operator journal"
VERSION = 1
SUFFIX = ".journal"
# Of a line. The longest one holds a whole progress, some hundred kB; a longer one is something else. The file may be as
# long as the test: nothing that is written shall be too long to be read.
MAX_LINE_BYTES = 16 * 1024 * 1024
_CRC = b',"crc":"%08x"}\n'
# A link under the name of a journal may lead to any file; it is never written through.
_FLAGS = getattr(os, "O_BINARY", 0) | getattr(os, "O_NOFOLLOW", 0)
_CRC_LENGTH = len(_CRC % 0)


@dataclass(frozen=True)
class Entry:
    """One entry; sequence counts from 1."""

    sequence: int
    kind: str
    values: Mapping[str, Any]


@dataclass(frozen=True)
class Recovered:
    """The good entries of a journal.

    Attributes:
        content: their lines. is_damaged: reading ended before the end of the file.
        is_torn: the last line only lacks its end, as after a loss of power; nothing that was complete is lost.
    """

    entries: tuple[Entry, ...]
    content: bytes
    is_damaged: bool = False
    is_torn: bool = False

    @property
    def mark(self) -> JournalMark | None:
        """Which journal it is and how far it reaches; None when it is empty."""
        if not self.entries:
            return None
        return JournalMark(str(self.entries[0].values.get("id")), self.entries[-1].sequence)

    @property
    def holds_findings(self) -> bool:
        """True when something was measured."""
        return any(entry.kind in (POINT, LINE) or entry.values.get("progress", {}).get("results")
                   for entry in self.entries)


def journal_path(path: pathlib.Path) -> pathlib.Path:
    """Of the test with this progress file."""
    return path.with_suffix(SUFFIX)


def journal_of(path: pathlib.Path) -> Recovered:
    """Journal of the test with this progress file; an empty one when there is no file."""
    found = journal_path(path)
    return read_journal(found) if os.path.lexists(found) else Recovered((), b"")


def line_of(entry: Entry) -> bytes:
    """Line of an entry; ValueError for a number that is none."""
    values = {"seq": entry.sequence, "kind": entry.kind, "values": entry.values}
    body = json.dumps(values, ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode("utf-8")
    return body[:-1] + _CRC % zlib.crc32(body)


def read_journal(path: pathlib.Path) -> Recovered:
    """All entries up to the first one that is not good; ProgressFileError when the file cannot be read."""
    entries: list[Entry] = []
    lines: list[bytes] = []
    try:
        size = checked_size(path)
        with path.open("rb") as file:
            while line := file.readline(MAX_LINE_BYTES):
                entry = _entry(line) if line.endswith(b"\n") else None
                if entry is None or not _follows(entry, entries):
                    break
                entries.append(entry)
                lines.append(line)
    except OSError as error:
        raise ProgressFileError(f"The journal {path} cannot be read: {error.strerror or error}.") from None
    if not entries and size > MAX_LINE_BYTES:
        # None at all, which nobody shall copy or cut off.
        raise ProgressFileError(f"The journal {path} is larger than {MAX_LINE_BYTES // 1024 ** 2} MiB.")
    content = b"".join(lines)
    is_last = len(content) + len(line) == size
    return Recovered(tuple(entries), content, is_damaged=bool(line), is_torn=is_last and not line.endswith(b"\n"))


def _follows(entry: Entry, before: Sequence[Entry]) -> bool:
    if not before:
        return entry.kind == BEGUN
    last = before[-1].sequence
    return entry.sequence == last + 1 or (entry.kind == BEGUN and entry.sequence > last)


def _entry(line: bytes) -> Entry | None:
    body, crc = line[:-_CRC_LENGTH] + b"}", line[-_CRC_LENGTH:]
    if crc != _CRC % zlib.crc32(body):
        return None
    try:
        document = json.loads(body, parse_constant=_refuse_constant)
        entry = Entry(document["seq"], document["kind"], document["values"])
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    is_good = type(entry.sequence) is int and isinstance(entry.kind, str) and isinstance(entry.values, dict)
    return entry if is_good else None


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(name)


class JournalFile:
    """A journal that is open for appending, from its good part on."""

    def __init__(self, path: pathlib.Path):
        self._path = path
        self._descriptor: int | None = None
        self._size = 0

    def open(self, size: int) -> None:
        """Open or make the file, and cut off what lies behind its good part; OutputError when that fails."""
        self._open(size, os.O_CREAT)

    def make(self) -> None:
        """Make the file; OutputError when that fails, or when there is one already, which is left as it is."""
        self._open(0, os.O_CREAT | os.O_EXCL)

    def _open(self, size: int, how: int) -> None:
        try:
            self._descriptor = os.open(self._path, os.O_RDWR | how | _FLAGS, 0o644)
            if os.fstat(self._descriptor).st_size != size:
                os.ftruncate(self._descriptor, size)
            sync_folder(self._path.parent)
            self._size = size
        except OSError as error:
            raise self._failed(error) from None

    def append(self, lines: bytes) -> None:
        """Add whole lines; returns when they are safe. After an OutputError none of them is there."""
        descriptor = self._descriptor
        if descriptor is None:
            raise OutputError(f"The journal {self._path} is not open.")
        try:
            self._check(descriptor)
            os.lseek(descriptor, self._size, os.SEEK_SET)
            left = memoryview(lines)
            while left:
                left = left[os.write(descriptor, left):]
            os.fsync(descriptor)
        except OSError as error:
            self._cut(descriptor)
            raise self._failed(error) from None
        self._size += len(lines)

    def close(self) -> None:
        """Safe to call twice."""
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            os.close(descriptor)

    def _check(self, descriptor: int) -> None:
        # A file that was deleted or replaced takes every entry, and nobody would find it.
        mine, there = os.fstat(descriptor), os.stat(self._path)
        if not os.path.samestat(mine, there) or mine.st_size != self._size:
            raise OSError(0, "it was changed by another program")

    def _cut(self, descriptor: int) -> None:
        # Where even that fails, reading finds the torn entry by its check sum.
        with contextlib.suppress(OSError):
            os.ftruncate(descriptor, self._size)

    def _failed(self, error: OSError) -> OutputError:
        return OutputError(f"The file {self._path} cannot be written: {error.strerror or error}.")
