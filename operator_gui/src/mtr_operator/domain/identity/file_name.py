"""Names of files in documents: one plain name with the same meaning on every platform, never a path."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Callable

# File systems allow 255 bytes; suffixes such as ".part" and "_12" are added to a name.
MAX_BYTES = 200
# Maximum of a generated name, which leaves space for a number and a suffix.
MAX_MADE_BYTES = 150
_MAX_SHOWN = 60
_SEPARATORS = frozenset("/\\:")
# Windows opens a device for these names, with any suffix.
_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9\u00b9\u00b2\u00b3])\s*(\.|$)", re.IGNORECASE)

# This includes names with folders whose first or last part is empty.
SEPARATED = "It contains a path separator or a colon"
_RULES: tuple[tuple[Callable[[str], object], str], ...] = (
    (lambda name: _SEPARATORS & set(name), SEPARATED),
    # Control characters, bidirectional marks, zero-width characters and lone surrogates are not printable.
    (lambda name: not name.isprintable(), "It contains an invisible character"),
    (lambda name: name.startswith("."), "It begins with a dot"),
    (lambda name: name != name.strip() or name.endswith("."), "It begins or ends with a space, or ends with a dot"),
    (_DEVICE.match, "Windows reserves it for a device"),
    (lambda name: len(name.encode("utf-8")) > MAX_BYTES, f"File name too long: more than {MAX_BYTES} bytes"))


def name_problem(name: object) -> str:
    """Return why a name from a document must not become a path; empty for a plain file name."""
    if not isinstance(name, str) or not name:
        return "It is not a text"
    return next((problem for is_wrong, problem in _RULES if is_wrong(name)), "")


def shown(name: object) -> str:
    """Return the name for a sentence: short, and on one line."""
    text = name if isinstance(name, str) else repr(name)
    quoted = ascii(text[:_MAX_SHOWN]) if not text[:_MAX_SHOWN].isprintable() else repr(text[:_MAX_SHOWN])
    return quoted if len(text) <= _MAX_SHOWN else f"{quoted}..."


def to_file_name(text: str, usual: str, max_bytes: int = MAX_MADE_BYTES) -> str:
    """Return a plain file name as close as possible to a text; `usual` if nothing of the text remains."""
    letters = "".join(letter if letter.isprintable() and letter not in _SEPARATORS else "_" for letter in text)
    # The cut may split a character.
    name = letters.lstrip(". ").encode("utf-8")[:max_bytes - 1].decode("utf-8", "ignore").rstrip(". ")
    if _DEVICE.match(name):
        name = f"_{name}"
    return name or usual
