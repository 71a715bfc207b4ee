"""Search for tests, and the order of the list."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterable, Sequence

from mtr_operator.domain.results.session_record import in_utc
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.progress_file import FILE_NAME

from .bundles import is_bundle
from .entry import TestEntry
from .same_lines import MAX_TESTS


def listed(entries: Iterable[TestEntry]) -> list[TestEntry]:
    """Return one entry for each test, its most complete copy, newest first; then unreadable ones, by path."""
    tests: dict[str, TestEntry] = {}
    broken = []
    for entry in entries:
        if entry.problem:
            broken.append(entry)
        elif entry.test_id not in tests or _reach(entry) > _reach(tests[entry.test_id]):
            tests[entry.test_id] = entry
    return [*sorted(tests.values(), key=_moment, reverse=True),
            *sorted(broken, key=lambda entry: entry.path)]


def matching(entries: Sequence[TestEntry], text: str = "", *, car: str = "", key: str = "",
             verdict: str = "") -> list[TestEntry]:
    """Return tests that contain each word of a text, of this car, key and verdict; an empty text matches all.
    Unreadable files match nothing."""
    words = text.lower().split()
    wanted = {name: value for name, value in (("car", car), ("key", key), ("verdict", verdict)) if value}
    return [entry for entry in entries if not entry.problem
            and all(word in entry.words or word in entry.verdict for word in words)
            and all(getattr(entry, name) == value for name, value in wanted.items())]


def repetitions(entries: Sequence[TestEntry], entry: TestEntry) -> list[TestEntry]:
    """Return tests of an entry's car and key with its parameters and with measurements, itself included, oldest first;
    of very many the newest. Unrecorded cars and keys count as equal. Parameters of a test in the store are known only
    after reading."""
    alike = [each for each in entries if not each.problem and each.done
             and all(getattr(each, name) == getattr(entry, name) for name in ("scenario", "car", "key"))
             and (each.parameters == entry.parameters or "" in (each.parameters, entry.parameters))]
    return sorted(alike, key=_moment)[-MAX_TESTS:]


def unreadable(entries: Sequence[TestEntry], text: str = "") -> list[TestEntry]:
    """Return unreadable files whose reason contains each word of a text."""
    words = text.lower().split()
    return [entry for entry in entries if entry.problem and all(word in entry.problem.lower() for word in words)]


def values_of(entries: Sequence[TestEntry], name: str) -> list[str]:
    """Return the existing values of car, key or verdict, sorted."""
    return sorted({getattr(entry, name) for entry in entries} - {""})


def problems_of(entries: Sequence[TestEntry]) -> list[str]:
    """Return a sentence for each unreadable file."""
    return [entry.problem for entry in entries if entry.problem]


def _moment(entry: TestEntry) -> tuple[str, str, str]:
    """Return a sort key in UTC, because local times repeat when clocks are set back, and differ between time zones."""
    return in_utc(entry.started), entry.started, entry.path


def _reach(entry: TestEntry) -> tuple[int, int]:
    """Return a sort key of copies. Among equally complete ones the original, with its journal next to it, has priority.
    Then follow a file with its own name, the copy in a report, one in a bundle, and one of the store."""
    if entry.store:
        return entry.entries, -1
    if is_bundle(entry.file):
        return entry.entries, 0
    if journal_path(entry.file).exists():
        return entry.entries, 3
    return entry.entries, 1 if entry.file.name == FILE_NAME else 2
