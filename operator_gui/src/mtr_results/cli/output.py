"""Output of commands: tables for a person, JSON for a program."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from typing import Any, Sequence

from mtr_operator.terminal import show

_GAP = "  "


def print_json(document: Any) -> None:
    """Print one document and flush it, because a program may wait for the address of a server."""
    print(json.dumps(document, indent=1, ensure_ascii=False), flush=True)


def print_table(headings: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """Print left-aligned columns; columns of numbers are right-aligned."""
    texts = [list(map(str, headings)), *([cell(value) for value in row] for row in rows)]
    widths = [max(len(text[column]) for text in texts) for column in range(len(headings))]
    numeric = [all(isinstance(row[column], (int, float)) or row[column] is None for row in rows) and bool(rows)
               for column in range(len(headings))]
    for text in texts:
        cells = (word.rjust(width) if right else word.ljust(width)
                 for word, width, right in zip(text, widths, numeric))
        show(_GAP.join(cells).rstrip())


def cell(value: Any) -> str:
    """Return the text of a table cell: m to the millimetre, a dash for an empty value."""
    if value is None or value == "":
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.3f}" if isinstance(value, float) else str(value)
