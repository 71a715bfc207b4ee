"""Messages of a KCD or SYM database one by one, so that a faulty one costs no other."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import re
from dataclasses import dataclass, field
from typing import Any, Callable, Iterable
from xml.etree import ElementTree

import cantools

from ..further.sizes import size_words, too_large
from .car_database import Unread, printable
from .faults import cause, in_words

# Messages that are read one by one; whole cars have some hundred.
MAX_MESSAGES = 4096
# Limit of the characters of all separately read parts: per character of the file, and a constant.
_PER_CHARACTER, _BESIDES = 2, 512 * 1024
# Limit of the visits for one message: the library creates a codec for each page, and visits all signals for each.
MAX_VISITS = 1 << 22
TOO_MANY_PAGES = "a message has too many pages"
_MAX_SAID = 300
# Position in the part of the file that the library reads separately.
_PLACE = re.compile(r" at line \d+, column \d+")
_KCD = {"k": "http://kayak.2codeornot2code.org/1.0"}
_BITS_PER_BYTE = 8


@dataclass
class Separated:
    """Messages (cantools'), and the fault of each unreadable one by its name."""

    messages: list[Any] = field(default_factory=list)
    faults: dict[str, str] = field(default_factory=dict)
    unread: list[Unread] = field(default_factory=list)

    def add(self, read: Callable[[], Iterable[Any]], kind: str, unread: Iterable[Unread]) -> None:
        """Add what a reader returns, or the fault for which it raises an exception."""
        try:
            self.messages += read()
        # The library raises various exceptions for a faulty message.
        except Exception as error:
            said = _PLACE.sub("", " ".join(in_words(kind, cause(error)).split()))
            fault = printable(said.rstrip(".")[:_MAX_SAID])
            for each in unread:
                self.faults[each.name] = fault
                self.unread.append(each)


def kcd_messages(text: str) -> Separated | None:
    """Messages of a KCD file; None if it is a different kind of file, or has too many messages."""
    root = ElementTree.fromstring(text)
    pairs = [(bus, message) for bus in root.iterfind("k:Bus", _KCD) for message in bus.iterfind("k:Message", _KCD)]
    if len(pairs) > MAX_MESSAGES:
        return None
    found, left = Separated(), max_characters(text)
    for bus, message in pairs:
        document = ElementTree.Element(root.tag)
        part = ElementTree.SubElement(document, bus.tag, bus.attrib)
        part.append(message)
        alone = _written(document)
        left -= len(alone)
        if left < 0:
            return None
        unread = Unread(message.get("name", ""), single(message.get("id", "")), bus.get("name"))
        found.add(functools.partial(_loaded_kcd, alone, message), "KCD", [unread])
    return found


def _written(document: ElementTree.Element) -> str:
    """Return the document as text; empty if it is nested too deeply."""
    try:
        return ElementTree.tostring(document, "unicode")
    except RecursionError:
        return ""


def kcd_problem(text: str) -> str:
    """Return the fault of a KCD file that would take too long to read; empty if it would not."""
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError:
        # The library reports the position.
        return ""
    is_large = any(_visits(each) > MAX_VISITS for each in root.iterfind("k:Bus/k:Message", _KCD))
    return TOO_MANY_PAGES if is_large else ""


def _visits(message: ElementTree.Element) -> int:
    """Number of visits of signals by the library."""
    multiplexers, groups, signals = (sum(1 for _ in message.iter(f"{{{_KCD['k']}}}{tag}"))
                                     for tag in ("Multiplex", "MuxGroup", "Signal"))
    return (multiplexers + groups) * (multiplexers + signals)


def max_characters(text: str) -> int:
    """Return the limit of characters of all parts of a file; the parts repeat what several messages need."""
    return _PER_CHARACTER * len(text) + _BESIDES


def _loaded_kcd(document: str, message: ElementTree.Element) -> list[Any]:
    """The only message of a document. ValueError states a missing attribute, which the library does not name."""
    if not document:
        raise RecursionError
    if _visits(message) > MAX_VISITS:
        raise ValueError(TOO_MANY_PAGES)
    if message.get("id") is None:
        raise ValueError("its identifier is missing")
    for signal in (*message.iter(f"{{{_KCD['k']}}}Signal"), *message.iter(f"{{{_KCD['k']}}}Multiplex")):
        if signal.get("offset") is None:
            raise ValueError(f"its signal {signal.get('name')} has no offset")
    return loaded_alone(document, "kcd")


def loaded_alone(text: str, kind: str) -> list[Any]:
    """Return the messages of a part of a file. ValueError states a size that would use memory without limit."""
    size = too_large(text, f".{kind}")
    if size:
        raise ValueError(size_words(size))
    database: Any = cantools.database.load_string(text, kind, strict=False)
    return list(database.messages)


def with_kcd_lengths(text: str) -> str:
    """Return a KCD file in which each message without a length, or with the length "auto", gets the length of its last
    signal by bit position. The library would use the signal that begins last."""
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError:
        # The library reports the position.
        return text
    is_changed = False
    for message in root.iterfind("k:Bus/k:Message", _KCD):
        if message.get("length", "auto") != "auto":
            continue
        signals = [each for tag in ("Signal", "Multiplex") for each in message.iter(f"{{{_KCD['k']}}}{tag}")]
        try:
            end = max((int(each.get("offset", "")) + int(each.get("length", "1")) for each in signals), default=0)
        except ValueError:
            continue
        message.set("length", str(-(-max(end, 0) // _BITS_PER_BYTE)))
        is_changed = True
    return ElementTree.tostring(root, "unicode") if is_changed else text


def single(number: str) -> range:
    """Return an identifier as a range of one; an empty range if it is unreadable."""
    try:
        identifier = int(number, 0)
    except ValueError:
        return range(0)
    return range(identifier, identifier + 1)
