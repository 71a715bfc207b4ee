"""Decodes and encodes the raw values of signals in the data of a frame, for all users.

Only the named signals count: others may overlap them or lie outside the message. A frame may be shorter than in the
database; signals within it are read.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import struct
from typing import Any, Iterable, Iterator, Literal, Mapping, Union

BITS_PER_BYTE = 8
# IEEE 754 formats by their number of bits.
_FLOATS = {16: "e", 32: "f", 64: "d"}

Raw = Union[int, float]


class SignalReader:
    """Reads some signals of one message (cantools')."""

    def __init__(self, message: Any, names: Iterable[str]):
        by_name = {signal.name: signal for signal in message.signals}
        self._signals = {name: (by_name[name], pages(message, name)) for name in names if name in by_name}

    def values(self, data: bytes) -> dict[str, Any]:
        """Raw values by name; a signal is absent if it lies beyond the data, or another page is sent."""
        found = {}
        for name, (signal, multiplexers) in self._signals.items():
            value = raw_value(signal, data)
            if value is not None and all(_is_sent(each, data) for each in multiplexers):
                found[name] = value
        return found


def pages(message: Any, name: str) -> list[tuple[Any, frozenset[int]]]:
    """Return each multiplexer that selects a signal, from the signal upwards, with its values; KeyError if one is
    missing."""
    by_name = {signal.name: signal for signal in message.signals}
    found: list[tuple[Any, frozenset[int]]] = []
    signal = by_name[name]
    while signal.multiplexer_ids is not None and len(found) < len(by_name):
        multiplexer = by_name[signal.multiplexer_signal]
        found.append((multiplexer, frozenset(_unsigned(multiplexer, each) for each in signal.multiplexer_ids)))
        signal = multiplexer
    return found


def _is_sent(page: tuple[Any, frozenset[int]], data: bytes) -> bool:
    multiplexer, values = page
    bits = _bits(multiplexer, data)
    return bits is not None and bits in values


def raw_value(signal: Any, data: bytes) -> Raw | None:
    """Raw value of a signal regardless of its page; None if the data is too short for it."""
    bits = _bits(signal, data)
    if bits is None:
        return None
    if signal.conversion.is_float and signal.length in _FLOATS:
        code = _FLOATS[signal.length]
        return float(struct.unpack(f">{code}", bits.to_bytes(signal.length // BITS_PER_BYTE, "big"))[0])
    return bits - (1 << signal.length) if signal.is_signed and bits >> (signal.length - 1) else bits


def end_bit(signal: Any) -> int:
    """Least length in bits of a frame that contains the signal."""
    return int(_first_bit(signal) + signal.length)


def reading(signal: Any) -> tuple[Any, ...]:
    """Return the properties that determine the values of a signal; definitions that differ in them contradict."""
    pages_of = None if signal.multiplexer_ids is None else tuple(sorted(signal.multiplexer_ids))
    return (signal.start, signal.length, signal.byte_order, bool(signal.is_signed), bool(signal.conversion.is_float),
            signal.scale, signal.offset, signal.minimum, signal.maximum, signal.multiplexer_signal, pages_of)


def occupied(signal: Any) -> int:
    """Bits of a signal as a number, with bit 0 of the first byte lowest; 0 if it begins before the frame."""
    if signal.length < 1 or _first_bit(signal) < 0:
        return 0
    bits, end = (1 << signal.length) - 1, end_bit(signal)
    if not _is_big_endian(signal):
        return int(bits << signal.start)
    size = -(-end // BITS_PER_BYTE)
    return int.from_bytes((bits << BITS_PER_BYTE * size - end).to_bytes(size, "big"), "little")


def as_decoded(signal: Any, raw: int) -> int | None:
    """Return a raw value of a profile as it is decoded: 1 of a signed bit is -1. None if the signal has no such
    value."""
    if signal.conversion.is_float:
        return raw
    size = 1 << signal.length
    if not -(size >> 1 if signal.is_signed else 0) <= raw < size:
        return None
    return raw - size if signal.is_signed and raw >= size >> 1 else raw


def encode(message: Any, wanted: Mapping[str, Raw]) -> bytes:
    """Return data with these raw values; all other bits are 0, but multiplexers have an allowed value. ValueError if a
    signal has no such value, or lies outside the message."""
    data = bytearray(message.length)
    for name, value in (*_other_multiplexers(message, wanted), *wanted.items()):
        _write(message.get_signal_by_name(name), value, data)
    return bytes(data)


def _other_multiplexers(message: Any, wanted: Mapping[str, Raw]) -> Iterator[tuple[str, int]]:
    """Yield the multiplexer values that select the pages of the wanted signals, after the multiplexers that select
    none."""
    for signal in message.signals:
        ids = [each for child in message.signals if child.multiplexer_signal == signal.name
               for each in child.multiplexer_ids or ()]
        is_root = signal.multiplexer_ids is None
        if ids and 0 not in ids and is_root and end_bit(signal) <= BITS_PER_BYTE * message.length:
            yield signal.name, min(ids)
    for name in wanted:
        for multiplexer, values in pages(message, name):
            if multiplexer.name not in wanted:
                yield multiplexer.name, min(values)


def _write(signal: Any, value: Raw, data: bytearray) -> None:
    length, whole = signal.length, BITS_PER_BYTE * len(data)
    place = whole - end_bit(signal) if _is_big_endian(signal) else signal.start
    if place < 0 or place + length > whole:
        raise ValueError(f"signal {signal.name} does not lie within {len(data)} bytes")
    order: Literal["big", "little"] = "big" if _is_big_endian(signal) else "little"
    mask = ((1 << length) - 1) << place
    bits = int.from_bytes(data, order) & ~mask | _to_bits(signal, value) << place
    data[:] = bits.to_bytes(len(data), order)


def _to_bits(signal: Any, value: Raw) -> int:
    if signal.conversion.is_float and signal.length in _FLOATS:
        return int.from_bytes(struct.pack(f">{_FLOATS[signal.length]}", value), "big")
    if as_decoded(signal, int(value)) is None:
        raise ValueError(f"signal {signal.name} cannot carry the value {value}")
    return _unsigned(signal, int(value))


def _bits(signal: Any, data: bytes) -> int | None:
    """Return the unsigned bits of a signal; None if the data is too short."""
    spare = BITS_PER_BYTE * len(data) - end_bit(signal)
    if spare < 0:
        return None
    mask = (1 << signal.length) - 1
    if _is_big_endian(signal):
        return int(int.from_bytes(data, "big") >> spare & mask)
    return int(int.from_bytes(data, "little") >> signal.start & mask)


def _first_bit(signal: Any) -> int:
    """Return the number of the first bit in transmission byte order."""
    if _is_big_endian(signal):
        byte, bit = divmod(signal.start, BITS_PER_BYTE)
        return int(BITS_PER_BYTE * byte + BITS_PER_BYTE - 1 - bit)
    return int(signal.start)


def _is_big_endian(signal: Any) -> bool:
    return bool(signal.byte_order == "big_endian")


def _unsigned(signal: Any, value: int) -> int:
    return int(int(value) % (1 << signal.length))
