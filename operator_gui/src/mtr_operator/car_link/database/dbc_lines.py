"""Messages of a DBC file statement by statement, so that a faulty one costs no other."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Sequence

from ..further.sizes import is_too_large, size_words
from .dbc_statements import Statement, statements

_MESSAGE = re.compile(r"BO_\s+(\d{1,10})\s+([^:\"\n]*?)\s*:\s*(\d+)(?:\s|$)")
_SIGNAL = re.compile(
    r"SG_\s+([^:\"\n]*?)(?:\s+(M|m\d{1,10}M?|m))?\s*:\s*(\d+)\s*\|\s*(\d+)\s*@\s*([01])\s*([+-])\s*\(\s*([^,()]*?)"
    r"\s*,\s*([^,()]*?)\s*\)\s*(?:\[\s*([^\]|]*?)\s*\|\s*([^\]]*?)\s*\])?\s*(?:\"([^\"]*)\")?")
# Significant characters of a statement; lists of receivers may be longer.
_LONGEST = 4096
# Senders or receivers, which may be on lines of their own.
_NODES = re.compile(r"(?:\s*,?\s*\w+(?:\s*,\s*\w+)*)?[\s,;]*")
_NAMED = re.compile(r"(BO_|SG_)\s+(?:\d+\s+)?([^:\s\"]+)")
_DECODING = ("SG_MUL_VAL_", "SIG_VALTYPE_")
_OF_SIGNAL = re.compile(r"\w+\s+(\d{1,10})\s+([^\s:;,\"]+)")
_WORD = re.compile(r"[^\s:;,\"]+")
_PAGES = re.compile(r"SG_MUL_VAL_\s+(\d+)\s+(\S+)\s+(\S+)\s+([\d\s,-]+);")
_FLOAT = re.compile(r"SIG_VALTYPE_\s+(\d+)\s+([^\s:;]+)(?:\s*:\s*|\s+)([0-3])\s*;")
_CYCLE = re.compile(r"BA_\s+\"GenMsgCycleTime\"\s+BO_\s+(\d+)\s+(\d{1,9})(?!\d)")
_LONG_NAME = re.compile(r"BA_\s+\"System(?:Message|Signal)LongSymbol\"\s+(?:BO_|SG_)\s+(\d+)(?:\s+(\S+))?\s+\"(\w+)\"")
# Name under which signals without a message are collected.
_WITHOUT_MESSAGE = "VECTOR__INDEPENDENT_SIG_MSG"
_QUOTED = 120
# Limit of signals of one name in messages of one identifier; more are not a list of pages.
_MAX_SAME = 16
# Digits of the largest identifier.
_DIGITS = 10


@dataclass
class DbcSignal:
    """A statement SG_. page: such as M or m3, empty without one. scale, offset, limits: as written. ranges: values of
    the multiplexer in a separate statement, with its name. problem: reason why it cannot be used."""

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
    """A statement BO_ with its signals. problem: reason why it cannot be used."""

    name: str
    line: int
    text: str
    number: int = 0
    length: int = 0
    cycle_ms: int = 0
    signals: list[DbcSignal] = field(default_factory=list)
    problem: str = ""


def dbc_messages(text: str) -> list[DbcMessage]:
    """Return all messages in their order, without comments, tables of values and other attributes."""
    found: list[DbcMessage] = []
    rest: list[Statement] = []
    current: DbcMessage | None = None
    for statement in statements(text):
        is_understood = True
        if re.match(r"BO_\s", statement.bare):
            current, is_understood = _message(statement)
            found.append(current)
        elif not re.match(r"SG_\s", statement.bare):
            # Signals after an unparsed statement belong to no message.
            current = None
            rest.append(statement)
        elif current is not None:
            signal, is_understood = _signal(statement)
            current.signals.append(signal)
        current = current if is_understood else None
    _apply(rest, found)
    return [message for message in found if message.name != _WITHOUT_MESSAGE]


def quoted(text: str) -> str:
    """Return a line as quoted in a sentence."""
    return f'"{text[:_QUOTED]}"'


def _message(statement: Statement) -> tuple[DbcMessage, bool]:
    """Return a message, and True if its whole statement is understood."""
    match = _MESSAGE.match(statement.bare, 0, _LONGEST)
    if match is None:
        text = statement.code.partition("\n")[0]
        return DbcMessage(_name(text), statement.line, text, problem="the line is not complete"), text == statement.code
    identifier, name, length = match.groups()
    text, is_understood = _read(statement, match)
    problem = _size_problem(length)
    return DbcMessage(_spelled(name), statement.line, text, int(identifier), 0 if problem else int(length),
                      problem=problem), is_understood


def _signal(statement: Statement) -> tuple[DbcSignal, bool]:
    """Return a signal, and True if its whole statement is understood."""
    match = _SIGNAL.match(statement.code, 0, _LONGEST)
    if match is None:
        text = statement.code.partition("\n")[0]
        return DbcSignal(_name(text), statement.line, text, problem="the line is not complete"), text == statement.code
    name, page, start, length, order, sign, scale, offset, low, high, unit = match.groups("")
    text, is_understood = _read(statement, match)
    signal = DbcSignal(_spelled(name), statement.line, text, "M" if page == "m" else page, is_big_endian=order == "0",
                       is_signed=sign == "-", scale=scale, offset=offset, unit=unit,
                       limits=("0", "0") if match[9] is None else (low, high), problem=_size_problem(start, length))
    if not signal.problem:
        signal.start, signal.length = int(start), int(length)
        signal.problem = "" if signal.length else "it has no bit"
    return signal, is_understood


def _size_problem(*numbers: str) -> str:
    return next((size_words(number) for number in numbers if is_too_large(number)), "")


def _read(statement: Statement, match: re.Match[str]) -> tuple[str, bool]:
    """Return the text of a statement on one line. False if the text after its match may be another statement with a
    misspelled keyword."""
    same, _, further = statement.code[match.end():].partition("\n")
    is_understood = (not further and not statement.is_followed) or _NODES.fullmatch(f"{same}\n{further}") is not None
    return " ".join(f"{match[0]}{same}".split()), is_understood


def _name(line: str) -> str:
    match = _NAMED.match(line)
    return "" if match is None else _spelled(match[2])


def _spelled(name: str) -> str:
    """Return the name, with an underscore before a leading digit, because the format forbids one."""
    return f"_{name}" if name[:1].isdecimal() else name


def _apply(rest: Sequence[Statement], found: Sequence[DbcMessage]) -> None:
    """Apply statements with attributes to the messages and signals that they name."""
    by_name: dict[str, list[DbcSignal]] = {}
    by_number: dict[int, list[DbcMessage]] = {}
    by_both: dict[tuple[int, str], list[DbcSignal]] = {}
    for message in found:
        by_number.setdefault(message.number, []).append(message)
        for signal in message.signals:
            by_name.setdefault(signal.name, []).append(signal)
            by_both.setdefault((message.number, signal.name), []).append(signal)
    for statement in rest:
        if statement.bare.startswith(_DECODING):
            _decode(statement, by_both, by_name)
    _name_and_time([each.code for each in rest if each.bare.startswith("BA_")], by_number, by_both)


def _decode(statement: Statement, by_both: dict[tuple[int, str], list[DbcSignal]],
            by_name: dict[str, list[DbcSignal]]) -> None:
    """Apply a statement that changes the values of a signal; without its message, all signals of the name become
    unusable."""
    text = "".join(statement.bare.partition(";")[:2])
    wrong = f"line {statement.line} describes it as {quoted(' '.join(text.split()))}"
    named = _OF_SIGNAL.match(text)
    if named is None:
        for word in _WORD.findall(text, 0, _LONGEST):
            for signal in by_name.pop(_spelled(word), ()):
                signal.problem = wrong
        return
    match = None if statement.is_doubtful else (_PAGES if text.startswith("SG_MUL_VAL_") else _FLOAT).match(text)
    same = by_both.get((int(named[1]), _spelled(named[2])), [])
    is_repeated = len(same) > _MAX_SAME
    for signal in same:
        _extend(signal, None if is_repeated else match, wrong)
    if is_repeated:
        # These signals are unusable now; a further statement would cost time for each of them.
        same.clear()


def _extend(signal: DbcSignal, match: re.Match[str] | None, wrong: str) -> None:
    if match is None:
        signal.problem = wrong
    elif match.re is _FLOAT:
        signal.is_float = match[3] in "12"
    else:
        multiplexer = _spelled(match[3])
        ranges = [re.fullmatch(r"\s*(\d{1,10})\s*-\s*(\d{1,10})\s*", each) for each in match[4].split(",")]
        if not all(ranges) or signal.multiplexer not in ("", multiplexer):
            signal.problem = wrong
        signal.multiplexer = multiplexer
        signal.ranges += tuple((int(each[1]), int(each[2])) for each in ranges if each)


def _name_and_time(lines: Sequence[str], by_number: dict[int, list[DbcMessage]],
                   by_both: dict[tuple[int, str], list[DbcSignal]]) -> None:
    """Apply cycle times and long names; the last one of each counts. Other statements name signals by short names."""
    cycles: dict[int, int] = {}
    names: dict[tuple[int, str | None], str] = {}
    for line in lines:
        cycle, long_name = _CYCLE.match(line), _LONG_NAME.match(line)
        if cycle is not None:
            cycles[_number(cycle[1])] = int(cycle[2])
        elif long_name is not None:
            number, name, new = long_name.groups()
            names[_number(number), None if name is None else _spelled(name)] = _spelled(new)
    for number, cycle_ms in cycles.items():
        for message in by_number.get(number, ()):
            message.cycle_ms = cycle_ms
    for (number, short), new in names.items():
        if short is None:
            for message in by_number.get(number, ()):
                message.name = new
        else:
            for signal in by_both.get((number, short), ()):
                signal.name = new


def _number(digits: str) -> int:
    """Return an identifier; Python does not convert numbers with thousands of digits."""
    return int(digits[:_DIGITS])
