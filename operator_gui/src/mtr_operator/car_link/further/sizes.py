"""Checks positions and sizes in a CAN database before a library reads it, which creates a character for each bit."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

# Bits of the longest message of ISO 15765-2 with a 12-bit length; frames and J1939 transport have fewer.
MAX_SIZE = 8 * 4095
# Maximum digits of a number in a sentence.
_MAX_DIGITS = 20
# Positions and sizes in each kind of database: a signal's first bit and length in bits, a message's length in bytes.
# The library's time for digits of a SYM file is quadratic at any position.
_SIZES = {
    ".dbc": re.compile(r"(?<!\d)(\d+)\s*\|\s*(\d+)\s*@|\bBO_\s+\d+\s+\w+\s*:\s*(\d+)"),
    ".kcd": re.compile(r"\b(?:offset|length)\s*=\s*[\"']\s*(\d+)"),
    ".sym": re.compile(r"\bLen\s*=\s*(\d+)|^[ \t]*(?:Var|Mux)\s*=[^\n/]*?\s(\d+)\s*,\s*(\d+)"
                       r"|^[ \t]*Sig\s*=\s*(?:\"[^\"\n]*\"|\S+)\s+(\d+)|(\d{100})", re.MULTILINE),
    ".arxml": re.compile(r"(?:LENGTH|START-POSITION|BASE-TYPE-SIZE)>\s*(0[xX][\da-fA-F]+|\d+)"),
}


def too_large(text: str, suffix: str) -> str:
    """Return the first position or size in a database's text that exceeds all messages, as written; empty if all are
    valid."""
    pattern = _SIZES.get(suffix.lower())
    found = (number for match in pattern.finditer(text) for number in match.groups("0")) if pattern else ()
    return next((number[:_MAX_DIGITS] for number in found if is_too_large(number)), "")


def size_words(number: str) -> str:
    """Return the fault of a message or signal with such a position or size."""
    return (f"it says {number[:_MAX_DIGITS]} where a place or a size of a message or signal stands; allowed is up to "
            f"{MAX_SIZE}")


def is_too_large(number: str) -> bool:
    """Return True for a position or size that no message has."""
    # Python does not convert numbers with thousands of digits.
    digits = number.lower().replace("0x", "").lstrip("0")
    return len(digits) > len(str(MAX_SIZE)) or int(digits or "0", 16 if number[:2].lower() == "0x" else 10) > MAX_SIZE
