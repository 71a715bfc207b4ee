"""Statements of a DBC file, which end at keywords and semicolons instead of line ends."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Iterator, NamedTuple

# Number of characters before a keyword that decide whether it begins a statement.
_NEAR = 256
# A message or signal of this shape begins a statement anywhere, because no other statement has a colon there.
_SHAPED = r"BO_(?=\s+\d+\s+[^\s:\"]+\s*:)|SG_(?=\s+[^\s:\"]+(?:\s+[Mm]\w*)?\s*:)"
# Keywords that occur in no other statement.
_ALONE = ("CM_|BA_|BA_DEF_|BA_DEF_DEF_|BA_REL_|BA_DEF_REL_|BA_DEF_DEF_REL_|VAL_|VAL_TABLE_|SIG_GROUP_|SIG_VALTYPE_|"
          "SG_MUL_VAL_|BO_TX_BU_|ENVVAR_DATA_|SGTYPE_|SIG_TYPE_REF_")
_START = re.compile(rf"\b(?P<sure>(?:{_SHAPED})|(?:{_ALONE})\b)|^[ \t]*(?P<line>(?:BO_|SG_|BU_|EV_|NS_|BS_)(?![^\s:]))",
                    re.MULTILINE)
# Beginning of a comment or attribute that BO_ or SG_ on the next line continues.
_AWAITS = re.compile(r"\b(?:CM_|BA_DEF_|BA_\s+\"+)\s*\Z")
_TEXTS = re.compile(r"\"[^\"]*\"|//[^\n]*")
_TEXTS_OF_LINES = re.compile(r"\"[^\"\n]*(?:\"|$)|//[^\n]*", re.MULTILINE)
# Statements that change the decoding of a signal; the prefix distinguishes them from blanks and strings.
_PREFIX = 5
_DECODING = re.compile(r"\b(?:SIG_VALTYPE_|SG_MUL_VAL_)\s+\d[^;]{0,200}")


class Statement(NamedTuple):
    """A statement. line: number of its first line. code: without comments. bare: code with quotation marks for each
    character of a string. is_followed: another statement begins on its last line. is_doubtful: it may be part of a
    string, because one string of the file has no end."""

    line: int
    code: str
    bare: str
    is_followed: bool = False
    is_doubtful: bool = False


def without_texts(text: str) -> str:
    """Return a text without comments and strings; the whole text if a string has no end, because the library may see
    different strings."""
    return _masked(text, '"') if _is_balanced(text.replace('\\"', "''")) else text


def statements(text: str) -> Iterator[Statement]:
    """Yield all statements in their order; text before the first keyword is one as well."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace('\\"', "''")
    code, bare = _masked(text, ""), _masked(text, '"')
    starts = _starts(bare)
    line, position = 1, 0
    for start, end in zip(starts, [*starts[1:], len(bare)]):
        line, position = line + text.count("\n", position, start), start
        body = bare[start:end].rstrip()
        if body:
            is_followed = end < len(bare) and "\n" not in bare[start + len(body):end]
            yield Statement(line, _compact(code[start:start + len(body)]), _compact(body), is_followed)
    if not _is_balanced(text):
        line, position = 1, 0
        for match in _DECODING.finditer(text):
            line, position = line + text.count("\n", position, match.start()), match.start()
            if not bare.startswith(match[0][:_PREFIX], position):
                yield Statement(line, match[0], _compact(match[0]), is_doubtful=True)


def _starts(bare: str) -> list[int]:
    found = [0]
    for match in _START.finditer(bare):
        start = match.start(match.lastgroup or 0)
        is_continued = match["line"] in ("BO_", "SG_") and _AWAITS.search(bare, max(found[-1], start - _NEAR), start)
        if not is_continued:
            found.append(start)
    return found


def _is_balanced(text: str) -> bool:
    return text.count('"') % 2 == 0


def _masked(text: str, mark: str) -> str:
    """Return the text with blanks for comments; with the mark, if any, for each character of a string."""
    def replaced(match: re.Match[str]) -> str:
        is_string = match[0][0] == '"'
        return " " * len(match[0]) if not is_string else mark * len(match[0]) if mark else match[0]

    text = text.replace('\\"', "''")
    return (_TEXTS if _is_balanced(text) else _TEXTS_OF_LINES).sub(replaced, text)


def _compact(text: str) -> str:
    """Return the text with one blank or line end for each run of them."""
    lines = (" ".join(line.split()) for line in text.split("\n"))
    return "\n".join(line for line in lines if line)
