"""Detects contradictions in a SYM database that the library resolves silently by reading the first or last
definition."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import re
from typing import Any, Iterator, NamedTuple, Sequence

from .car_database import Problems
from .repeated import REPEATED

_KEYS = ("FormatVersion|Title|UniqueVariables|FloatDecimalPlaces|BRS|Enum|Sig|ID|Len|Mux|CycleTime|Timeout|MinInterval|"
         "Color|Var|Type")
_STRING = r'"(?:\\"|[^"])*"'
_NEXT = rf"\b(?:{_KEYS})\s*=|[\[{{]"
# A statement ends before the next one, not at the line end; units contain any character but blanks.
PART = re.compile(rf"//[^\n]*|(?P<section>\{{[A-Z]+\}})|\[\s*(?P<message>{_STRING}|[^\]\s\[]+)\s*\]|"
                   rf"\b(?P<key>{_KEYS})\s*=\s*"
                   rf"(?P<value>(?:[^A-Z\"/\[{{]+|/u:(?:{_STRING}|\S+)|//[^\n]*|{_STRING}|(?!{_NEXT})[^\"])*)|{_STRING}")
NAME = re.compile(rf"{_STRING}|[^\s=(\]-]+")
# Fields that do not affect values: unit, table of values, long name, default, decimals, SPN, display flags, comment.
_IDLE = re.compile(rf"/(?:u|e|ln|d|p|spn):(?:{_STRING}|\S+)|//[^\n]*|-[hbstv]\b")
_PLACE = re.compile(r"(?<!\d)(\d{1,9})\s*,\s*(\d{1,9})")
SIGNALS = "{SIGNALS}"
# Statements of which the library reads the first per message.
_ONCE = ("ID", "Len", "Type", "Mux")

# Definitions that must be unique, with their lines.
_Lines = dict[str, int]


class _Block(NamedTuple):
    """Part of a section: a message, or a page of it. number: in the file."""

    number: int = 0
    section: str = ""
    message: str = ""
    line: int = 0


class _Statement(NamedTuple):
    """A statement, such as Len=8."""

    line: int
    block: _Block
    key: str
    value: str


def sym_problems(text: str, messages: Sequence[Any], found: Problems) -> None:
    """Add contradictions to the faults of messages and signals, and record the lines of messages."""
    statements = list(_statements(text))
    found.message_lines.update((each.block.message, each.block.line) for each in statements if each.key == "ID")
    for (_, name, key), lines in _repeated(statements).items():
        if len(lines) > 1:
            found.messages[name] = f"its {key} is there more than once, in lines {_joined(lines)}"
    definitions = {name: lines for name, lines in _definitions(statements).items() if len(lines) > 1}
    for message in messages:
        for signal in message.signals:
            if signal.name in definitions:
                found.signals[message.name, signal.name] = f"{REPEATED}, in lines {_joined(definitions[signal.name])}"


def _statements(text: str) -> Iterator[_Statement]:
    block, line, position = _Block(), 1, 0
    for part in PART.finditer(text):
        line, position = line + text.count("\n", position, part.start()), part.start()
        if part["section"]:
            block = _Block(block.number, part["section"])
        elif part["message"] is not None:
            block = _Block(block.number + 1, block.section, unquoted(part["message"]), line)
        elif part["key"]:
            yield _Statement(line, block, part["key"], part["value"])


def _repeated(statements: Sequence[_Statement]) -> dict[tuple[Any, str, str], _Lines]:
    """Return the statements that must be unique in a message, by number of the block or its section, message and
    key."""
    found: dict[tuple[Any, str, str], _Lines] = collections.defaultdict(dict)
    for each in statements:
        block = each.block
        if block.message and each.key in _ONCE:
            found[block.number, block.message, each.key].setdefault(_facts(each.value), each.line)
            if each.key == "Mux":
                # Pages of a message are listed as messages of one name and section; the library reads the first
                # position.
                found[block.section, block.message, each.key].setdefault(_place(each.value), each.line)
    return found


def _definitions(statements: Sequence[_Statement]) -> dict[str, _Lines]:
    """Return the definitions of signals by name; the library reads the last one."""
    found: dict[str, _Lines] = collections.defaultdict(dict)
    for each in statements:
        name = NAME.match(each.value)
        if each.key == "Sig" and each.block.section == SIGNALS and name is not None:
            found[unquoted(name[0])].setdefault(_facts(each.value[name.end():]), each.line)
    return found


def _facts(value: str) -> str:
    return " ".join(sorted(_IDLE.sub(" ", value).split()))


def _place(value: str) -> str:
    bare = re.sub(_STRING, "", _IDLE.sub(" ", value))
    place = _PLACE.search(bare)
    return "" if place is None else f"{place[1]},{place[2]} {'-m' in bare.split()}"


def unquoted(name: str) -> str:
    return name[1:-1].replace('\\"', '"') if name[:1] == '"' else name


def _joined(lines: _Lines) -> str:
    return ", ".join(str(line) for line in sorted(lines.values()))
