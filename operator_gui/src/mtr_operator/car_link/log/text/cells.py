"""Cells of a table of frames, as the words that different tools write into them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

_YES = ("true", "t", "1", "yes", "y", "x", "on")
_NO = ("false", "f", "0", "no", "n", "off")


def is_set(word: str, column: str) -> bool:
    """Return whether a column of yes and no says yes; an empty one says no. ValueError for any other word."""
    return bool(word) and _choice(word, column, _YES, _NO)


def _choice(word: str, column: str, yes: tuple[str, ...], no: tuple[str, ...]) -> bool:
    plain = re.sub(r"(?<=\w)[-_ ](?=\w)", "", word.lower())
    if plain not in (*yes, *no):
        raise ValueError(f"has the word {word} in the column {column}, which is neither yes nor no")
    return plain in yes
