"""Which tests a person looks for, and in which order they are listed."""
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
    """One entry for each test, the copy that reaches farthest, newest first; then what cannot be read, by its path."""
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
    """Tests in which each word of a text occurs, of this car, key and verdict; an empty text fits all. What cannot be
    read fits nothing."""
    words = text.lower().split()
    wanted = {name: value for name, value in (("car", car), ("key", key), ("verdict", verdict)) if value}
    return [entry for entry in entries if not entry.problem
            and all(word in entry.words or word in entry.verdict for word in words)
            and all(getattr(entry, name) == value for name, value in wanted.items())]


def repetitions(entries: Sequence[TestEntry], entry: TestEntry) -> list[TestEntry]:
    """Tests of an entry's car and key with its parameters that have measured something, itself among them, oldest
    first; of very many the newest. What nobody said of car and key is the same as what nobody said. Which
    parameters a test of the store has shows when it is read."""
    alike = [each for each in entries if not each.problem and each.done
             and all(getattr(each, name) == getattr(entry, name) for name in ("scenario", "car", "key"))
             and (each.parameters == entry.parameters or "" in (each.parameters, entry.parameters))]
    return sorted(alike, key=_moment)[-MAX_TESTS:]


def unreadable(entries: Sequence[TestEntry], text: str = "") -> list[TestEntry]:
    """What cannot be read, and each word of a text occurs in why not."""
    words = text.lower().split()
    return [entry for entry in entries if entry.problem and all(word in entry.problem.lower() for word in words)]


def values_of(entries: Sequence[TestEntry], name: str) -> list[str]:
    """Values of car, key or verdict that there are, sorted."""
    return sorted({getattr(entry, name) for entry in entries} - {""})


def problems_of(entries: Sequence[TestEntry]) -> list[str]:
    """A sentence for each file that cannot be read."""
    return [entry.problem for entry in entries if entry.problem]


def _moment(entry: TestEntry) -> tuple[str, str, str]:
    """Local times repeat when clocks are set back, and differ between time zones."""
    return in_utc(entry.started), entry.started, entry.path


def _reach(entry: TestEntry) -> tuple[int, int]:
    """Of copies that reach equally far, the original counts: it has the journal beside it. The others in this order: a
    file of a name of its own, the copy in a report, one in a bundle, and one of the store, which has to be fetched."""
    if entry.store:
        return entry.entries, -1
    if is_bundle(entry.file):
        return entry.entries, 0
    if journal_path(entry.file).exists():
        return entry.entries, 3
    return entry.entries, 1 if entry.file.name == FILE_NAME else 2
