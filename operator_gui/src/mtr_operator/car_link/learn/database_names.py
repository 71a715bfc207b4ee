"""Names of the bits that followed the locks in a CAN database, so that a profile can use its message and signal."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Any, Mapping, NamedTuple

from mtr_operator.domain.ports import LockState

from ..database.codec import SignalReader
from ..database.load import load_database
from .bits import BITS_PER_BYTE
from .counters import Field
from .findings import Candidate


class Named(NamedTuple):
    """message, signal: names. values: raw, of the whole signal, by the state of the locks."""

    message: str
    signal: str
    values: Mapping[LockState, int]


class DatabaseNames:
    """Names in a database. path: of any kind that cantools reads; ConnectionFailed states a fault."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        self._database = load_database(path)
        self._messages = {(each.frame_id, each.is_extended_frame): each for each in self._database.messages}

    def named(self, candidate: Candidate) -> Named | None:
        """Return the signal with most of a candidate's bits and one value in each state; None without one."""
        message = self._messages.get(candidate.id)
        if message is None:
            return None
        bits = _bits(candidate.field)
        found = [(len(bits & bits_of(signal)), -signal.length, signal.name, values) for signal in message.signals
                 if bits & bits_of(signal) and self._database.is_usable(message, signal.name)
                 and (values := _values(message, signal.name, candidate)) is not None]
        if not found:
            return None
        *_, name, values = max(found, key=lambda each: each[:2])
        return Named(message.name, name, values)

    def counter(self, candidate: Candidate, least: Field | None, most: Field | None) -> str:
        """Return the name of the signal of the candidate's message that contains the bits of least and lies within
        most; empty without one."""
        if least is None or most is None:
            return ""
        message = self._messages[candidate.id]
        return next((signal.name for signal in message.signals
                     if _bits(least) <= bits_of(signal) <= _bits(most) and min(bits_of(signal)) == least.start
                     and self._database.is_usable(message, signal.name)), "")


def bits_of(signal: Any) -> set[int]:
    """Return the numbers of a signal's (cantools') bits, from 0 in the lowest bit of the first byte, as in Field."""
    if signal.byte_order == "little_endian":
        return set(range(signal.start, signal.start + signal.length))
    found, bit = set(), signal.start
    # The order descends from the highest bit and continues at the highest bit of the next byte, as in the DBC format.
    for _ in range(signal.length):
        found.add(bit)
        bit += -1 if bit % BITS_PER_BYTE else 2 * BITS_PER_BYTE - 1
    return found


def _bits(field: Field) -> set[int]:
    return set(range(field.start, field.start + field.width))


def _values(message: Any, name: str, candidate: Candidate) -> dict[LockState, int] | None:
    """Return the raw values of a signal; None if it had several values in a state, or the same in both."""
    reader, found = SignalReader(message, (name,)), dict[LockState, set[int]]()
    for state, data in candidate.data:
        raw = reader.values(data).get(name)
        if type(raw) is not int:
            return None
        found.setdefault(state, set()).add(raw)
    values = {state: raws.pop() for state, raws in found.items() if len(raws) == 1}
    return values if len(values) == len(found) == len(set(values.values())) == len(candidate.values) else None
