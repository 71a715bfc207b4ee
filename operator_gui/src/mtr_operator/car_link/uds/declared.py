"""Entry of a car's profile that polls the lock state: ECU, data identifier and position in the data."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, TypeVar

from cantools.database.can import Message

from ..further.entries import Entries, is_whole
from .addresses import Addresses

Reading = TypeVar("Reading")

_KEYS = {"request_id", "response_id", "is_extended", "data_identifier", "byte", "mask", "every_s"}
_REQUIRED_KEYS = {"request_id", "response_id", "data_identifier"}
_MAX_STANDARD, _MAX_EXTENDED, _MAX_IDENTIFIER, _MAX_BYTE, _MAX_MASK = 0x7FF, 0x1FFF_FFFF, 0xFFFF, 4094, 0xFF
# Frequent enough for a distance, rare enough for the diagnostics of an ECU, which have low priority there.
_EVERY_S, _MIN_EVERY_S, _MAX_EVERY_S = 0.2, 0.05, 10.0
_BYTES = 8


@dataclass(frozen=True)
class UdsPoll:
    """ReadDataByIdentifier, ISO 14229-1: data_identifier of addresses, every every_s. The state is a byte of its data,
    masked by mask and shifted right by the mask's trailing zeros."""

    addresses: Addresses
    data_identifier: int
    byte: int = 0
    mask: int = _MAX_MASK
    every_s: float = _EVERY_S

    @property
    def name(self) -> str:
        """Substitute of a signal's name."""
        return f"DID 0x{self.data_identifier:04X}"

    def decoder(self, reading: Callable[[int], Reading]) -> Callable[[int, bool, bytes], Reading | None]:
        """Return a decoder of frames in their order. reading: of a raw value."""
        from .transport import AnsweredValues
        values = AnsweredValues(self.addresses, self.data_identifier)

        def decode(can_id: int, is_extended: bool, data: bytes) -> Reading | None:
            value = values.frame(can_id, is_extended, data)
            return None if value is None or len(value) <= self.byte else reading(self.raw(value))
        return decode

    def raw(self, value: bytes) -> int:
        """Return the state in the data of the identifier."""
        return (value[self.byte] & self.mask) // (self.mask & -self.mask)


def response_message(poll: UdsPoll) -> Message:
    """Return a substitute for the message of a Car that sends its state."""
    addresses = poll.addresses
    return Message(addresses.response_id, f"answer to {poll.name}", _BYTES, [],
                   is_extended_frame=addresses.is_extended)


def read_poll(entries: Entries) -> UdsPoll:
    """Read the entry uds_poll of a profile; ConnectionFailed states a fault."""
    table = entries.content["uds_poll"]
    if not isinstance(table, dict) or not _REQUIRED_KEYS <= set(table) <= _KEYS:
        raise entries.wrong(f"uds_poll must be a table of {', '.join(sorted(_KEYS))}; needed are "
                            f"{', '.join(sorted(_REQUIRED_KEYS))}.")
    is_extended = bool(table.get("is_extended", False))
    largest = _MAX_EXTENDED if is_extended else _MAX_STANDARD
    values = {"request_id": largest, "response_id": largest, "data_identifier": _MAX_IDENTIFIER, "byte": _MAX_BYTE,
              "mask": _MAX_MASK}
    for key, most in values.items():
        least = 1 if key == "mask" else 0
        value = table.get(key, least)
        if not is_whole(value) or not least <= value <= most:
            raise entries.wrong(f"uds_poll has {key}: {value!r}; allowed is {least} to {most:#x}.")
    every_s = _every_s(entries, table)
    return UdsPoll(Addresses(table["request_id"], table["response_id"], is_extended), table["data_identifier"],
                   table.get("byte", 0), table.get("mask", _MAX_MASK), every_s)


def _every_s(entries: Entries, table: dict[str, Any]) -> float:
    every_s = table.get("every_s", _EVERY_S)
    is_number = isinstance(every_s, (int, float)) and not isinstance(every_s, bool)
    if not is_number or not _MIN_EVERY_S <= every_s <= _MAX_EVERY_S:
        raise entries.wrong(f"every_s is {every_s}; allowed is {_MIN_EVERY_S:g} to {_MAX_EVERY_S:g} s.")
    return float(every_s)
