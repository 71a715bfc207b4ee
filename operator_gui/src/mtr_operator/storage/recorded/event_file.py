"""The event list of one run on disk: CSV, one row an entry, only ever appended to."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
import datetime
import pathlib
from typing import Iterator, Mapping, TextIO

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.eventlog.entry import SEVERITY_WORDS, EventEntry, EventKind

from .spreadsheet import guarded, unguarded

COLUMNS = ("time", "robot_time_s", "kind", "severity", "source", "text")
# A robot that says something new with each Status for a day; the rest is not kept.
MAX_ENTRIES = 1_000_000
_ROBOT_TIME_DIGITS = 3
_SEVERITIES = {word: severity for severity, word in SEVERITY_WORDS.items()}


class EventFile:
    """Begins the file with the first entry. A disk that is full ends it, and no test.

    Attributes: problem: why it ended; empty while it goes on.
    """

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.problem = ""
        self._count = 0
        self._file: TextIO | None = None

    def add(self, entry: EventEntry) -> None:
        """Keep an entry; it has left this program when this returns."""
        if self.problem:
            return
        self._count += 1
        if self._count > MAX_ENTRIES:
            self.problem = f"The event list {self.path} holds {MAX_ENTRIES} entries; the rest is not kept."
            return
        try:
            self._append(entry)
        except OSError as error:
            self.problem = f"The event list is not kept in {self.path} any more: {error.strerror or error}."

    def close(self) -> None:
        """Safe to call twice."""
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _append(self, entry: EventEntry) -> None:
        if self._file is None:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._file = open(self.path, "x", encoding="utf-8", newline="")  # noqa: SIM115, closed by close()
            csv.writer(self._file).writerow(COLUMNS)
        csv.writer(self._file).writerow(_row(entry))
        self._file.flush()


def _row(entry: EventEntry) -> tuple[str, ...]:
    robot_time = "" if entry.robot_time_s is None else f"{entry.robot_time_s:.{_ROBOT_TIME_DIGITS}f}"
    return (entry.time.isoformat(timespec="milliseconds"), robot_time, entry.kind.value,
            SEVERITY_WORDS[entry.severity], guarded(entry.source), guarded(" ".join(entry.text.split())))


def read_events(path: pathlib.Path) -> Iterator[EventEntry]:
    """All that is whole; ProgressFileError when it is no event list, or damaged."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            yield from _entries(path, file)
    except OSError as error:
        raise ProgressFileError(f"The event list {path} cannot be read: {error.strerror or error}.") from None


def _entries(path: pathlib.Path, file: TextIO) -> Iterator[EventEntry]:
    rows = csv.DictReader(file)
    try:
        if tuple(rows.fieldnames or ()) != COLUMNS:
            raise ValueError("other columns")
        for row in rows:
            # What a killed application has left.
            if None not in row.values():
                yield _entry(row)
    except (ValueError, KeyError, csv.Error):
        raise ProgressFileError(f"The event list {path} is damaged in line {max(rows.line_num, 1)}, or of another "
                                "version.") from None


def _entry(row: Mapping[str, str]) -> EventEntry:
    return EventEntry(datetime.datetime.fromisoformat(row["time"]),
                      float(row["robot_time_s"]) if row["robot_time_s"] else None, EventKind(row["kind"]),
                      _SEVERITIES[row["severity"]], unguarded(row["source"]), unguarded(row["text"]))
