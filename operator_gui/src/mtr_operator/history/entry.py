"""What a list of tests says of each."""
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
    """One test, or a file that holds none.

    Attributes:
        path: of the progress file, or of the journal where that is all there is; in a store the test's number there.
        problem: why it cannot be read; empty when it can. Without one the others mean something.
        test_id: the same in each copy of the test. entries: how far this copy reaches.
        started: as in the record. scenario: its name. parameters: the same for tests with the same ones.
        car, key, operator, place: as they are told apart, empty where nobody said it.
        done, total, invalid: lines. is_complete: none is left to be measured.
        verdict: word of the test's verdict, empty without limits.
        words: all that a search looks at, in small letters.
        store: in which the test is, empty for one in a file.
    """

    # The name would make pytest collect it.
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
        """See path; of a test in a store it is none."""
        return pathlib.Path(self.path)

    @property
    def name(self) -> str:
        """By which a sentence tells a person which test it is about."""
        return f"{self.scenario} {self.moment}" if self.store else self.file.name

    @functools.cached_property
    def moment(self) -> str:
        """When it began, to the minute, local time: "2026-11-22 15:36"."""
        return self.started.replace("T", " ")[:16]

    def to_document(self) -> dict[str, Any]:
        """Plain values for a file: what is not empty."""
        defaults = {field.name: field.default for field in dataclasses.fields(self)}
        return {name: getattr(self, name) for name, default in defaults.items() if getattr(self, name) != default}


def entry_from(document: Any) -> TestEntry:
    """Entry in a document; KeyError, TypeError or ValueError when it is damaged."""
    return read_record(TestEntry, document)
