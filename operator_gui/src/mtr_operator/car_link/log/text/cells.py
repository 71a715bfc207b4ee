"""Cells of a table of frames, in the notations of different tools."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Sequence

from .lines import (
    CLASSIC_BYTES,
    MAX_STANDARD,
    WrongShape,
    fd_length,
    hex_bytes,
    hex_id,
    moment,
    seconds,
    some_bytes,
)

_BYTE_DIGITS = 2
# Maximum characters of a cell in a sentence.
_QUOTED = 30
# Data length codes of more than eight bytes.
_LONG_CODES = range(9, 16)
_YES = ("true", "t", "1", "yes", "y", "x", "on")
_NO = ("false", "f", "0", "no", "n", "off")
_EXTENDED = (*_YES, "extended", "ext", "xtd", "29", "29bit", "eff")
_STANDARD = (*_NO, "standard", "std", "s", "11", "11bit", "sff")


def cell_time(text: str, unit_s: float) -> float:
    """Return a time in s; unit_s: of a number. ValueError for a text that is neither a number nor a date and time."""
    try:
        return seconds(text) * unit_s
    except WrongShape:
        pass
    try:
        return moment(text)
    except WrongShape:
        raise ValueError(f"has the time {text[:_QUOTED]}, which is no number") from None


def cell_id(text: str) -> int:
    """Return an identifier; ValueError for a text that is not a hexadecimal number."""
    try:
        return hex_id(text)
    except WrongShape:
        raise ValueError(f"has the identifier {text[:_QUOTED]}, which is no hexadecimal number") from None


def is_set(word: str, column: str) -> bool:
    """Return the value of a yes/no column; an empty one is False. ValueError for any other word."""
    return bool(word) and _choice(word, column, _YES, _NO)


def is_extended(word: str, can_id: int) -> bool:
    """Return True for an extended identifier; without a word, its value decides. ValueError for a word that names
    neither format."""
    return _choice(word, "extended", _EXTENDED, _STANDARD) if word else can_id > MAX_STANDARD


def cell_data(words: Sequence[str], length: str) -> bytes:
    """Return the data of one column: a word for each byte, or bytes without blanks. length: empty if not stated."""
    if length:
        is_whole = len(words) == 1 and not _is_byte(words[0])
        present = len(words[0]) // _BYTE_DIGITS if is_whole else sum(map(_is_byte, words))
        count = data_length(length, present)
        if present > max(count, CLASSIC_BYTES) or (is_whole and present != count):
            raise ValueError(f"has {present} bytes of data, and says {count}")
        return hex_bytes(words[0]) if is_whole else some_bytes(words, count)
    if all(map(_is_byte, words)):
        return some_bytes(words, len(words))
    return b"".join(map(hex_bytes, words))


def data_length(text: str, present: int) -> int:
    """Return the length of the data: from 9 on it may be a data length code. present: bytes in the line. ValueError if
    neither length matches; padding to the columns of a classic frame is not a contradiction."""
    count = int(text)
    if count not in _LONG_CODES or present == count:
        return count
    if present != fd_length(count):
        raise ValueError(f"has {present} bytes of data, and says {count}")
    return present


def _is_byte(word: str) -> bool:
    return bool(re.fullmatch(r"(?:0[xX])?[0-9A-Fa-f]{1,2}", word))


def _choice(word: str, column: str, yes: tuple[str, ...], no: tuple[str, ...]) -> bool:
    plain = re.sub(r"(?<=\w)[-_ ](?=\w)", "", word.lower())
    if plain not in (*yes, *no):
        raise ValueError(f"has the word {word[:_QUOTED]} in the column {column}, which is neither yes nor no")
    return plain in yes
