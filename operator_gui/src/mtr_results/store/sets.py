"""Test sets as written by a person: "12", "12,17", or "campaign=winter,key=0042"."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

from sqlalchemy import Connection

from mtr_operator.history.line_pairs import Side
from mtr_operator.history.same_lines import MAX_TESTS

from ..errors import StoreError
from .reading import Row, Search, find, number_of, side, test_row

_NAMES = [field.name for field in fields(Search) if field.name not in ("limit", "offset")]


@dataclass(frozen=True)
class TestSet:
    """Attributes: text: as written. rows: of the tests, oldest first. sides: the tests, in the same order."""

    # Without this, pytest would collect the class because of its name.
    __test__ = False

    text: str
    rows: list[Row]
    sides: list[Side]

    def values(self, factor: str) -> list[str]:
        """Return the level of a factor for each test."""
        return [level(row, factor) for row in self.rows]


# Factor -> columns of a test that define its level.
FACTORS = {"key": ("key_serial", "key_type"), "car": ("vin", "model"), "software": ("car_software",),
           "place": ("place",), "operator": ("operator",), "robot": ("robot",), "campaign": ("campaign",)}


def level(row: Row, factor: str) -> str:
    """Return the level of a factor for a test, such as its key, car or place."""
    return " ".join(filter(None, (str(row[name] or "") for name in FACTORS[factor])))


def read_set(connection: Connection, text: str) -> TestSet:
    """Read the selected tests; StoreError if there are none or too many for one evaluation."""
    if "=" in text:
        search = _search(text)
        numbers = [row["id"] for row in reversed(find(connection, search))]
        if len(numbers) > MAX_TESTS:
            raise StoreError(f"More than {MAX_TESTS} tests fit {text}; narrow the search.")
    else:
        numbers = [number_of(connection, word.strip()) for word in text.split(",")]
    if not numbers:
        raise StoreError(f"No test fits {text}; mtr-results list shows what there is.")
    return _ordered(connection, text, list(dict.fromkeys(numbers)))


def _ordered(connection: Connection, text: str, numbers: list[int]) -> TestSet:
    rows = sorted((test_row(connection, number) for number in numbers), key=lambda row: (row["started_utc"], row["id"]))
    return TestSet(text, rows, [side(connection, row["id"]) for row in rows])


def _search(text: str) -> Search:
    wanted: dict[str, Any] = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        if name.strip() not in _NAMES or not value.strip():
            raise StoreError(f"{part} is no part of a set; give numbers of tests, or NAME=VALUE with "
                             f"{', '.join(_NAMES)}.")
        wanted[name.strip()] = value.strip()
    return replace(Search(limit=MAX_TESTS + 1), **wanted)
