"""A CAN database as a profile uses it: only the named messages and signals must be correct."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from dataclasses import dataclass, field
from typing import Any, Sequence

from mtr_operator.domain.errors import ConnectionFailed

from .codec import BITS_PER_BYTE, end_bit, pages
from .repeated import REPEATED, contradicting

# Characters of a name in a sentence.
_MAX_NAME = 100


@dataclass
class Problems:
    """Lines by the names of messages and signals, empty if unknown; and the faults of messages and signals."""

    message_lines: dict[str, int] = field(default_factory=dict)
    signal_lines: dict[tuple[str, str], int] = field(default_factory=dict)
    messages: dict[str, str] = field(default_factory=dict)
    signals: dict[tuple[str, str], str] = field(default_factory=dict)


@dataclass(frozen=True)
class Unread:
    """An unreadable message. identifiers: its possible identifiers; bus: None if unknown."""

    name: str
    identifiers: range
    bus: str | None = None


class CarDatabase:
    """Database with its faults. messages: cantools'. refusal: the library's reason for refusing the whole file; empty
    if it did not. unread: unreadable messages, which may share the identifier of another one."""

    def __init__(self, path: pathlib.Path, messages: Sequence[Any], problems: Problems, refusal: str = "",
                 unread: Sequence[Unread] = ()):
        self.path = path
        self.messages = messages
        self._problems = problems
        self._refusal = refusal
        self._unread_messages = unread

    def message(self, name: str) -> Any:
        """Return a message by its name; ConnectionFailed states the fault of one that cannot be used."""
        found = ([message for message in self.messages if message.name == each] for each in _spellings(name))
        known = next(filter(None, found), [])
        problem = next((self._problems.messages[each] for each in _spellings(name)
                        if each in self._problems.messages), "") or (known and _negative(known[-1]))
        if problem:
            place = f"{self.path}{_line(self._problems.message_lines.get(name))}"
            raise ConnectionFailed(f"Message {name} of CAN database {place} cannot be used: {problem}.")
        if known:
            return known[-1]
        raise ConnectionFailed(f"CAN database {self.path} has no message {name}{self._unread()}.")

    def signal(self, message: Any, name: str) -> str:
        """Return a signal's name as spelled in the database; ConnectionFailed states the fault of an unusable one."""
        known = {signal.name: signal for signal in message.signals}
        for each in _spellings(name):
            problem = self._problems.signals.get((message.name, each), "")
            if not problem and each not in known:
                continue
            problem = problem or _misplaced(message, known[each]) or _without_number(known[each]) or (
                self._without_page(message, each) or self._as_another_message(message, each))
            if not problem:
                return each
            place = f"{self.path}{_line(self._problems.signal_lines.get((message.name, each)))}"
            raise ConnectionFailed(f"Signal {name} of message {message.name} of CAN database {place} cannot be used: "
                                   f"{problem}.")
        raise ConnectionFailed(f"Message {message.name} of CAN database {self.path} has no signal {name}"
                               f"{self._unread()}.")

    def _unread(self) -> str:
        """Return the reason for a missing message or signal: the library's refusal, else the first faulty message."""
        if self._refusal:
            return f"; not all of it could be read: {self._refusal}"
        for name, problem in self._problems.messages.items():
            # A repeated message was read, so it is not the missing one.
            if not problem.startswith(REPEATED):
                return f"; message {self._placed(name)} could not be read: {problem}"
        return ""

    def _placed(self, name: str) -> str:
        """Return a message name with its line."""
        return f"{printable(name)[:_MAX_NAME]}{_line(self._problems.message_lines.get(name))}"

    def _without_page(self, message: Any, name: str) -> str:
        try:
            multiplexers = [multiplexer for multiplexer, _ in pages(message, name)]
        except KeyError as error:
            return f"its multiplexer {error.args[0]} is not in the message"
        faults = ((each.name, self._problems.signals.get((message.name, each.name)) or _misplaced(message, each))
                  for each in multiplexers)
        return next((f"its multiplexer {name} cannot be used: {fault}" for name, fault in faults if fault), "")

    def _as_another_message(self, message: Any, name: str) -> str:
        for unread in self._unread_messages:
            if message.frame_id in unread.identifiers and unread.bus in (None, message.bus_name):
                return (f"message {self._placed(unread.name)} has the same identifier {message.frame_id:#x} and could "
                        "not be read")
        other = contradicting(message, name, self.messages)
        return "" if other is None else (f"message {self._placed(other.name)} has the same identifier "
                                         f"{message.frame_id:#x} and contradicts it")

    def is_usable(self, message: Any, name: str) -> bool:
        """Return True for a signal that a profile can name."""
        try:
            return self.message(message.name) is message and self.signal(message, name) == name
        except ConnectionFailed:
            return False


def printable(text: str) -> str:
    """Return a text from outside without control characters and other unprintable characters."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def _spellings(name: str) -> tuple[str, ...]:
    """Return the possible names; a name that begins with a digit gets an underscore, see dbc_lines."""
    return (name, f"_{name}") if name[:1].isdecimal() else (name,)


def _line(number: int | None) -> str:
    return "" if number is None else f", line {number},"


def _negative(message: Any) -> str:
    if message.frame_id < 0:
        return "its identifier is negative"
    return "its length is negative" if message.length < 0 else ""


def _misplaced(message: Any, signal: Any) -> str:
    if signal.length < 1:
        return "it has no bit"
    end = end_bit(signal)
    if end < signal.length:
        return "it begins before the first bit of the message"
    if end <= BITS_PER_BYTE * message.length:
        return ""
    return f"it ends at bit {end}, and the message has {BITS_PER_BYTE * message.length} bits"


def _without_number(signal: Any) -> str:
    return "" if is_finite(signal.scale) and is_finite(signal.offset) else "its scale or offset is not a finite number"


def is_finite(number: Any) -> bool:
    """Return True if a number of a database is finite as a float; integers may have any number of digits."""
    try:
        return math.isfinite(number)
    except OverflowError:
        return False
