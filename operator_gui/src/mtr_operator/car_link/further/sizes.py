"""Places and sizes in a CAN database before a library reads it, which makes a character of each bit."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

# Bits of the longest message of ISO 15765-2 with a length of 12 bits; frames and J1939's transport have fewer.
MAX_SIZE = 8 * 4095
# Digits of a number in a sentence.
_MAX_DIGITS = 20
# Where databases of each kind have them: a signal's first bit and bits, a message's bytes.
# The library's time for digits of a SYM is quadratic, wherever they are.
_SIZES = {
    ".dbc": re.compile(r"(?<!\d)(\d+)\s*\|\s*(\d+)\s*@|\bBO_\s+\d+\s+\w+\s*:\s*(\d+)"),
    ".kcd": re.compile(r"\b(?:offset|length)\s*=\s*[\"']\s*(\d+)"),
    ".sym": re.compile(r"\bLen\s*=\s*(\d+)|^[ \t]*(?:Var|Mux)\s*=[^\n/]*?\s(\d+)\s*,\s*(\d+)"
                       r"|^[ \t]*Sig\s*=\s*(?:\"[^\"\n]*\"|\S+)\s+(\d+)|(\d{100})", re.MULTILINE),
    ".arxml": re.compile(r"(?:LENGTH|START-POSITION|BASE-TYPE-SIZE)>\s*(0[xX][\da-fA-F]+|\d+)"),
}


def too_large(text: str, suffix: str) -> str:
    """The first place or size in a database's text that no message has, as it stands there; empty when all may be."""
    pattern = _SIZES.get(suffix.lower())
    found = (number for match in pattern.finditer(text) for number in match.groups("0")) if pattern else ()
    return next((number[:_MAX_DIGITS] for number in found if is_too_large(number)), "")


def size_words(number: str) -> str:
    """What is wrong with a message or signal that says such a place or size."""
    return (f"it says {number[:_MAX_DIGITS]} where a place or a size of a message or signal stands; allowed is up to "
            f"{MAX_SIZE}")


def is_too_large(number: str) -> bool:
    """True for a place or size that no message has."""
    # Python converts no number of thousands of digits.
    digits = number.lower().replace("0x", "").lstrip("0")
    return len(digits) > len(str(MAX_SIZE)) or int(digits or "0", 16 if number[:2].lower() == "0x" else 10) > MAX_SIZE
