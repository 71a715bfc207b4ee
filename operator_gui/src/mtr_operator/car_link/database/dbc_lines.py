"""Messages of a DBC file line by line, so that one that is wrong costs no other."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Iterator

_MESSAGE = re.compile(r"BO_\s+(\d{1,10})\s+([^:\"]*?)\s*:\s*(\d{1,6})(?:\s|$)")
_SIGNAL = re.compile(
    r"SG_\s+([^:\"]*?)(?:\s+(M|m\d{1,10}M?|m))?\s*:\s*(\d{1,6})\s*\|\s*(\d{1,6})\s*@\s*([01])\s*([+-])\s*\(\s*([^,()]*?)\s*,"
    r"\s*([^,()]*?)\s*\)\s*(?:\[[^\]]*?\|[^\]]*\])?\s*(?:\"([^\"]*)\")?")
_RANGE = re.compile(r"\[\s*([^|\]]*?)\s*\|\s*([^\]]*?)\s*\]")
_NAMED = re.compile(r"(BO_|SG_)\s+(?:\d+\s+)?([^:\s\"]+)")
_PAGES = re.compile(r"SG_MUL_VAL_\s+(\d+)\s+(\S+)\s+(\S+)\s+([\d\s,-]+);")
_FLOAT = re.compile(r"SIG_VALTYPE_\s+(\d+)\s+(\S+?)\s*:?\s*([0-3])\s*;")
_CYCLE = re.compile(r"BA_\s+\"GenMsgCycleTime\"\s+BO_\s+(\d+)\s+(\d{1,9})(?!\d)")
_LONG_NAME = re.compile(r"BA_\s+\"System(?:Message|Signal)LongSymbol\"\s+(?:BO_|SG_)\s+(\d+)(?:\s+(\S+))?\s+\"(\w+)\"")
# Signals that no message has are collected under this name.
_WITHOUT_MESSAGE = "VECTOR__INDEPENDENT_SIG_MSG"
_QUOTED = 120


@dataclass
class DbcSignal:
    """A line SG_. page: such as M or m3, empty without one. texts: numbers as they are written. pages: values of the
    multiplexer in a line of its own, with its name. problem: why it cannot be used."""

    name: str
    line: int
    text: str
    page: str = ""
    start: int = 0
    length: int = 0
    is_big_endian: bool = False
    is_signed: bool = False
    is_float: bool = False
    scale: str = "1"
    offset: str = "0"
    limits: tuple[str, str] = ("0", "0")
    unit: str = ""
    multiplexer: str = ""
    ranges: tuple[tuple[int, int], ...] = ()
    problem: str = ""


@dataclass
class DbcMessage:
    """A line BO_ with its signals. problem: why it cannot be used."""

    name: str
    line: int
    text: str
    number: int = 0
    length: int = 0
    cycle_ms: int = 0
    signals: list[DbcSignal] = field(default_factory=list)
    problem: str = ""


def dbc_messages(text: str) -> list[DbcMessage]:
    """All messages in their order; comments, tables of values and other attributes are left out."""
    found: list[DbcMessage] = []
    rest: list[tuple[int, str]] = []
    current: DbcMessage | None = None
    for number, line in _statements(text):
        if line.startswith(("BO_ ", "BO_\t")):
            current = _message(number, line)
            found.append(current)
        elif not line.startswith(("SG_ ", "SG_\t")):
            # Signals behind a line that is not understood belong to no message.
            current = None
            rest.append((number, line))
        elif current is not None:
            current.signals.append(_signal(number, line))
    by_number: dict[str, list[DbcMessage]] = {}
    for message in found:
        by_number.setdefault(str(message.number), []).append(message)
    # Long names last: the other lines name signals by their short names.
    for number, line in sorted(rest, key=lambda each: each[1].startswith("BA_")):
        _apply(number, line, by_number)
    return [message for message in found if message.name != _WITHOUT_MESSAGE]


def quoted(text: str) -> str:
    """A line as a sentence shows it."""
    return f'"{text[:_QUOTED]}"'


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Number and text of each line that does not continue a string of a line before."""
    is_balanced = text.replace('\\"', "").count('"') % 2 == 0
    is_inside = False
    for number, line in enumerate(text.splitlines(), 1):
        stripped, was_inside = line.strip(), is_inside
        if is_balanced and line.replace('\\"', "").count('"') % 2:
            is_inside = not is_inside
        if stripped and not was_inside and not stripped.startswith("//"):
            yield number, stripped


def _message(number: int, line: str) -> DbcMessage:
    match = _MESSAGE.match(line)
    if match is None:
        return DbcMessage(_name(line), number, line, problem="the line is not complete")
    identifier, name, length = match.groups()
    return DbcMessage(_spelled(name), number, line, int(identifier), int(length))


def _signal(number: int, line: str) -> DbcSignal:
    match = _SIGNAL.match(line)
    if match is None:
        return DbcSignal(_name(line), number, line, problem="the line is not complete")
    name, page, start, length, order, sign, scale, offset, unit = match.groups("")
    page = "M" if page == "m" else page
    limits = _RANGE.search(line)
    signal = DbcSignal(_spelled(name), number, line, page, int(start), int(length), order == "0", sign == "-",
                       scale=scale, offset=offset, unit=unit,
                       limits=("0", "0") if limits is None else (limits[1], limits[2]))
    if not signal.length:
        signal.problem = "it has no bit"
    return signal


def _name(line: str) -> str:
    match = _NAMED.match(line)
    return "" if match is None else _spelled(match[2])


def _spelled(name: str) -> str:
    """Names that begin with a digit get a line before it, because the format forbids them."""
    return f"_{name}" if name[:1].isdecimal() else name


def _apply(number: int, line: str, messages: dict[str, list[DbcMessage]]) -> None:
    """Apply a line with attributes to the messages and signals that it names."""
    if line.startswith(("SG_MUL_VAL_", "SIG_VALTYPE_")):
        words = line.split()
        match = (_PAGES if line.startswith("SG_MUL_VAL_") else _FLOAT).match(line)
        for message in messages.get(words[1] if len(words) > 1 else "", ()):
            for signal in message.signals:
                if len(words) > 2 and signal.name == _spelled(words[2].rstrip(":")):
                    _extend(signal, match, f"line {number} describes it as {quoted(line)}")
    elif line.startswith("BA_"):
        _attribute(line, messages)


def _extend(signal: DbcSignal, match: re.Match[str] | None, wrong: str) -> None:
    if match is None:
        signal.problem = wrong
    elif match.re is _FLOAT:
        signal.is_float = match[3] in "12"
    else:
        signal.multiplexer = _spelled(match[3])
        ranges = [re.fullmatch(r"\s*(\d{1,10})\s*-\s*(\d{1,10})\s*", each) for each in match[4].split(",")]
        if not all(ranges):
            signal.problem = wrong
        signal.ranges += tuple((int(each[1]), int(each[2])) for each in ranges if each)


def _attribute(line: str, messages: dict[str, list[DbcMessage]]) -> None:
    cycle, long_name = _CYCLE.match(line), _LONG_NAME.match(line)
    if cycle is not None:
        for message in messages.get(cycle[1], ()):
            message.cycle_ms = int(cycle[2])
    elif long_name is not None:
        number, name, new = long_name.groups()
        for message in messages.get(number, ()):
            if name is None:
                message.name = _spelled(new)
            for signal in message.signals:
                if name is not None and signal.name == _spelled(name):
                    signal.name = _spelled(new)
