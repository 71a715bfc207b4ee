"""Estimates the time and memory of the library for a SYM database: it repeats all signals of a message per
identifier."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import re
from typing import NamedTuple, Sequence

from .alone import MAX_VISITS, TOO_MANY_PAGES
from .sym_text import PART, unquoted

# Same pattern as in the library: the second number is the end of a range, with any character before it.
IDENTIFIERS = re.compile(r"ID\s*=\s*-?(\d[0-9A-Fa-f]*)h(?:\s*-?([0-9A-Fa-f]+)h)?")
# Limit of the repeated signals of all messages: all identifiers but the first repeat them.
MAX_REPEATED = 1 << 14
# Digits of an identifier.
_DIGITS = 8


class Expansion(NamedTuple):
    """Repeated signals of all messages. visits: of the message with the most."""

    repeated: int
    visits: int

    def problem(self) -> str:
        """Return the fault of a file that would use too much time or memory; empty if it would not."""
        if self.repeated > MAX_REPEATED:
            return f"its ranges of identifiers repeat more than {MAX_REPEATED} signals"
        return TOO_MANY_PAGES if self.visits > MAX_VISITS else ""


def expansion(text: str) -> Expansion:
    """Return the cost of a file for the library."""
    # Strings and comments count as well, so that no large range is missed.
    largest = max(map(_count, IDENTIFIERS.findall(text)), default=0)
    if largest > MAX_REPEATED:
        return Expansion(largest, 0)
    counts: dict[tuple[str, str], dict[str, int]] = collections.defaultdict(collections.Counter)
    section, message = "", ""
    for part in PART.finditer(text):
        if part["section"]:
            section, message = part["section"], ""
        elif part["message"] is not None:
            message = unquoted(part["message"])
        elif part["key"]:
            found = IDENTIFIERS.match(part[0]) if part["key"] == "ID" else None
            counts[section, message][part["key"]] += 1 if found is None else _count(found.groups(""))
    messages = [each for (_, name), each in counts.items() if name]
    signals = [each["Sig"] + each["Var"] + 1 for each in messages]
    repeated = sum(max(each["ID"] - 1, 0) * size for each, size in zip(messages, signals))
    return Expansion(repeated, max((each["Mux"] * size for each, size in zip(messages, signals)), default=0))


def _count(ends: Sequence[str]) -> int:
    """Number of identifiers of a range."""
    low, high = (each.lstrip("0") for each in ends)
    if len(high) > _DIGITS or len(low) > _DIGITS:
        return MAX_REPEATED + 1 if high else 1
    return max(1, int(high, 16) - int(low or "0", 16) + 1) if high else 1
