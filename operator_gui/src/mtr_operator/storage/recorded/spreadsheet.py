"""Texts of people and robots in cells of a table that a spreadsheet opens: never a formula."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

# By which spreadsheets know a text.
_TEXT = "'"
# A cell that begins as a formula does; of numbers with a sign there may be several in one.
_FORMULA = re.compile(r"\s*[=@]|[\t\r]|\s*[-+](?![-+.\d\s]*$)")


def guarded(text: str) -> str:
    """The text as a cell; an apostrophe before what a spreadsheet would compute."""
    return _TEXT + text if _FORMULA.match(text.lstrip(_TEXT)) else text


def unguarded(cell: str) -> str:
    """The text of a cell of guarded()."""
    return cell[1:] if cell.startswith(_TEXT) and _FORMULA.match(cell.lstrip(_TEXT)) else cell
