"""Texts compared and sorted alike on every database, whatever collation it was made with."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterable

from sqlalchemy import String
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement


class ByCodePoint(FunctionElement[str]):
    """A text column in the order of its characters' code points, which is that of SQLite and of Python."""

    inherit_cache = True
    name = "by_code_point"
    type = String()


@compiles(ByCodePoint)
def _as_it_is(element: ByCodePoint, compiler: Any, **options: Any) -> str:
    return f"({compiler.process(element.clauses, **options)})"


@compiles(ByCodePoint, "postgresql")
def _collated(element: ByCodePoint, compiler: Any, **options: Any) -> str:
    # The collation of a locale ignores punctuation, or sorts it behind digits.
    return f'({compiler.process(element.clauses, **options)}) COLLATE "C"'


def ordering(columns: Iterable[Any]) -> list[Any]:
    """Columns to sort by; texts by code point."""
    return [ByCodePoint(column) if isinstance(column.type, String) else column for column in columns]
