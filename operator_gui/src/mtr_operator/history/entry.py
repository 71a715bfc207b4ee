"""Entry of a test in a list."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import functools
import pathlib
from dataclasses import dataclass
from typing import Any

from mtr_operator.domain.results.document import read_record


@dataclass(frozen=True)
class TestEntry:
    """One test, or a file without one.

    Attributes:
        path: of the progress file, or of a journal without one; for a test in a store, its number there. problem:
        reason why it cannot be read; empty if it can. The other attributes are valid only without a problem. test_id:
        the same in each copy of the test. entries: extent of this copy.
        started: as in the record. scenario: its name. parameters: equal for tests with equal ones.
        car, key, operator, place: identifying texts, empty if not recorded.
        done, total, invalid: lines. is_complete: all lines are measured.
        verdict: word of the test's verdict, empty without limits.
        words: searchable text, in lower case.
        store: that contains the test, empty for a test in a file.
    """

    # Otherwise pytest would collect it because of its name.
    __test__ = False

    path: str
    problem: str = ""
    test_id: str = ""
    entries: int = 0
    started: str = ""
    scenario: str = ""
    parameters: str = ""
    car: str = ""
    key: str = ""
    operator: str = ""
    place: str = ""
    done: int = 0
    total: int = 0
    invalid: int = 0
    is_complete: bool = False
    verdict: str = ""
    words: str = ""
    store: str = ""

    @property
    def file(self) -> pathlib.Path:
        """Path of the test; meaningless for a test in a store."""
        return pathlib.Path(self.path)

    @property
    def name(self) -> str:
        """Name of the test in sentences."""
        return f"{self.scenario} {self.moment}" if self.store else self.file.name

    @functools.cached_property
    def moment(self) -> str:
        """Start of the test, to the minute, local time: "2026-11-22 15:36"."""
        return self.started.replace("T", " ")[:16]

    def to_document(self) -> dict[str, Any]:
        """Return the attributes that are not empty as plain values for a file."""
        defaults = {field.name: field.default for field in dataclasses.fields(self)}
        return {name: getattr(self, name) for name, default in defaults.items() if getattr(self, name) != default}


def entry_from(document: Any) -> TestEntry:
    """Return the entry in a document; KeyError, TypeError or ValueError if it is damaged."""
    return read_record(TestEntry, document)
