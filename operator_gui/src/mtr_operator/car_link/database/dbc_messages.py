"""Builds cantools messages from the lines of a DBC file, of which some may be wrong, and collects the faults."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Any, Iterator, Sequence

from cantools.database.can import Message, Signal
from cantools.database.conversion import BaseConversion

from .car_database import Problems
from .dbc_lines import DbcMessage, DbcSignal, quoted
from .repeated import REPEATED

_EXTENDED, _STANDARD_BITS, _EXTENDED_BITS = 0x8000_0000, 11, 29
# Limit of the multiplexer values of one signal; more are a mistake.
_MAX_PAGES = 4096
# Limits: the library creates a codec for each page, and for each it visits all signals of the message with all pages.
_MAX_VISITS, _PAGES_PER_VISIT = 1 << 22, 16


def built(lines: Sequence[DbcMessage]) -> list[Any]:
    """Return the messages without a fault, each without its faulty signals; record the faults in the lines."""
    found = []
    visits = 0
    for message in lines:
        names = [each.name for each in message.signals if each.page.endswith("M")]
        visits += _visits(message, len(names))
        if names and visits > _MAX_VISITS:
            message.problem = message.problem or "this message and those before it have too many pages"
        if message.problem:
            continue
        signals = [each for each in (_signal(line, message, names) for line in message.signals) if each is not None]
        identifier = message.number & ~_EXTENDED
        is_extended = bool(message.number & _EXTENDED)
        bits = _EXTENDED_BITS if is_extended else _STANDARD_BITS
        if identifier >> bits:
            message.problem = (f"the identifier {identifier} has more than {bits} bits" + (
                "" if is_extended or identifier >> _EXTENDED_BITS else
                f"; one of 29 bits is written with {_EXTENDED} added to it"))
        if not message.problem:
            found.append(Message(identifier, message.name, message.length, signals, is_extended_frame=is_extended,
                                 cycle_time=message.cycle_ms or None, strict=False))
    return found


def _visits(message: DbcMessage, multiplexers: int) -> int:
    """Number of visits of signals by the library, which is quadratic."""
    paged = sum(each.page not in ("", "M") for each in message.signals)
    ranges = [(low, high) for each in message.signals for low, high in each.ranges if low <= high]
    listed = sum(high - low + 1 for low, high in ranges)
    span = max((high for _, high in ranges), default=-1) - min((low for low, _ in ranges), default=0) + 1
    return (multiplexers + paged + min(listed, span)) * (len(message.signals) + listed // _PAGES_PER_VISIT)


def _signal(line: DbcSignal, message: DbcMessage, multiplexers: Sequence[str]) -> Signal | None:
    multiplexer, ids = _pages(line, multiplexers)
    if line.problem:
        return None
    try:
        scale, offset = float(line.scale), float(line.offset)
        conversion = BaseConversion.factory(scale=scale, offset=offset, is_float=line.is_float)
    except ValueError:
        line.problem = "scale or offset is no number"
        return None
    low, high = (_number(text) for text in line.limits)
    is_limited = low is not None and high is not None and low < high
    signal = Signal(line.name, line.start, line.length, "big_endian" if line.is_big_endian else "little_endian",
                    line.is_signed, conversion=conversion, minimum=low if is_limited else None,
                    maximum=high if is_limited else None, unit=line.unit or None,
                    is_multiplexer=line.page.endswith("M"), multiplexer_ids=ids, multiplexer_signal=multiplexer)
    if _is_accepted(signal, message):
        return signal
    line.problem = "its length does not fit its type"
    return None


def _is_accepted(signal: Signal, message: DbcMessage) -> bool:
    """False for a signal for which the library cannot create a codec."""
    alone = Signal(signal.name, signal.start, signal.length, signal.byte_order, signal.is_signed,
                   conversion=signal.conversion)
    try:
        Message(0, message.name, message.length, [alone], strict=False)
    # The library for bits raises various exceptions.
    except Exception:
        return False
    return True


def _pages(line: DbcSignal, names: Sequence[str]) -> tuple[str | None, list[int] | None]:
    """Return the multiplexer and its values; None for an unconditional signal. names: multiplexers of the message."""
    if line.page in ("", "M"):
        return None, None
    multiplexer = line.multiplexer or (names[0] if len(names) == 1 else "")
    if multiplexer not in names or multiplexer == line.name:
        line.problem = line.problem or "it is a page of a multiplexer that the message does not name"
        return None, None
    own = () if line.ranges else (int(line.page.strip("mM")),)
    if sum(high - low + 1 for low, high in line.ranges) > _MAX_PAGES:
        line.problem = line.problem or "it has too many values of its multiplexer"
        return None, None
    return multiplexer, sorted({*own, *(each for low, high in line.ranges for each in range(low, high + 1))})


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def problems(lines: Sequence[DbcMessage], messages: Sequence[Any]) -> Problems:
    """Return the faults of messages and signals by their names. messages: the usable ones."""
    found = Problems({message.name: message.line for message in lines},
                     {(message.name, signal.name): signal.line for message in lines for signal in message.signals})
    for name, same in _several(lines):
        if any(_facts(each) != _facts(same[0]) for each in same):
            found.messages[name] = f"{REPEATED}, in lines {_joined(same)}"
    usable = {message.name: {signal.name: signal for signal in message.signals} for message in messages}
    for message in lines:
        if message.problem:
            found.messages[message.name] = f"{message.problem}: {quoted(message.text)}"
        known = usable.get(message.name, {})
        for name, same in _several(message.signals):
            if any(_facts(each) != _facts(same[0]) for each in same):
                found.signals[message.name, name] = f"{REPEATED}, in lines {_joined(same)}"
        for line in message.signals:
            problem = line.problem
            if line.name in known:
                is_page = line.page not in ("", "M")
                problem = "it is a page of a multiplexer that the message does not name" \
                    if is_page and known[line.name].multiplexer_ids is None else ""
            if problem:
                found.signals[message.name, line.name] = f"{problem}: {quoted(line.text)}"
    return found


def _several(lines: Sequence[Any]) -> Iterator[tuple[str, list[Any]]]:
    by_name: dict[str, list[Any]] = collections.defaultdict(list)
    for line in lines:
        by_name[line.name].append(line)
    return ((name, same) for name, same in by_name.items() if len(same) > 1)


def _joined(lines: Sequence[Any]) -> str:
    return ", ".join(str(line.line) for line in lines)


def _facts(line: Any) -> Any:
    """Return the properties in which two lines of one name must agree."""
    if isinstance(line, DbcMessage):
        return line.number, line.length, sorted(map(_facts, line.signals), key=str)
    # Distances of phones depend on scale and offset, values of counters on the limits.
    numbers = (line.scale, line.offset, *line.limits)
    return (line.name, line.page, line.start, line.length, line.is_big_endian, line.is_signed, line.is_float,
            *(text if (number := _number(text)) is None else number for text in numbers))
