"""Comparison and sorting of texts, identical on every database and for every collation."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterable

from sqlalchemy import String
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement


class ByCodePoint(FunctionElement[str]):
    """A text column in code point order, like SQLite and Python."""

    inherit_cache = True
    name = "by_code_point"
    type = String()


@compiles(ByCodePoint)
def _as_it_is(element: ByCodePoint, compiler: Any, **options: Any) -> str:
    return f"({compiler.process(element.clauses, **options)})"


@compiles(ByCodePoint, "postgresql")
def _collated(element: ByCodePoint, compiler: Any, **options: Any) -> str:
    # Collations of a locale ignore punctuation or sort it after digits.
    return f'({compiler.process(element.clauses, **options)}) COLLATE "C"'


def ordering(columns: Iterable[Any]) -> list[Any]:
    """Return columns for sorting; texts by code point."""
    return [ByCodePoint(column) if isinstance(column.type, String) else column for column in columns]
