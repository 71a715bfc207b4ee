"""Outputs of a profile: a message to a device at the Car, its signal, and the values of both states."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import can

from mtr_operator.domain.errors import ConnectionFailed

from ..database.codec import encode
from ..further.entries import Entries, is_whole

HANDLE_KEY, EXTENDER_KEY = "handle_request", "extender_switch"
# Names of the two values; the active state is first.
_VALUES = {HANDLE_KEY: ("taken", "released"), EXTENDER_KEY: ("switched_on", "switched_off")}


@dataclass(frozen=True, eq=False)
class DeclaredOutput:
    """Message of an output. active, idle: its data in both states."""

    can_id: int
    is_extended: bool
    active: bytes
    idle: bytes

    def frame(self, is_active: bool) -> can.Message:
        """Return the frame to send."""
        return can.Message(arbitration_id=self.can_id, is_extended_id=self.is_extended,
                           data=self.active if is_active else self.idle)


def read_output(entries: Entries, key: str) -> DeclaredOutput | None:
    """Read the entry HANDLE_KEY or EXTENDER_KEY; None if the profile lacks it, ConnectionFailed states a fault."""
    if key not in entries.content:
        return None
    table, (active, idle) = entries.content[key], _VALUES[key]
    allowed = ("message", "signal", active, idle)
    if not isinstance(table, dict) or set(table) != set(allowed):
        raise entries.wrong(f"{key} must be a table of {', '.join(allowed)}.")
    for name in (active, idle):
        if not is_whole(table[name]):
            raise entries.wrong(f"{key} has {name}: {table[name]!r}; allowed is a whole number.")
    if table[active] == table[idle]:
        raise entries.wrong(f"{active} and {idle} of {key} are both {table[active]}; give two values.")
    message = entries.message(table["message"])
    return _output(message, entries.signal(message, table["signal"]), table[active], table[idle])


def _output(message: Any, signal: str, active: int, idle: int) -> DeclaredOutput:
    """Return an output whose other signals are 0; ConnectionFailed if the signal does not have these values."""
    return DeclaredOutput(message.frame_id, message.is_extended_frame, _data(message, signal, active),
                          _data(message, signal, idle))


def _data(message: Any, signal: str, value: int) -> bytes:
    try:
        return encode(message, {signal: value})
    except (ValueError, OverflowError):
        raise ConnectionFailed(f"Signal {signal} of message {message.name} cannot carry the value {value}.") from None
