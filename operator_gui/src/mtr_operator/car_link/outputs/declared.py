"""Outputs as a profile declares them: a message, its signal, and the values for both of its states."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..further.entries import Entries, is_whole
from ..handle import HandleOutput, handle_output

HANDLE_KEY, EXTENDER_KEY = "handle_request", "extender_switch"
# Names of the two values, that of the active state first.
_VALUES = {HANDLE_KEY: ("taken", "released"), EXTENDER_KEY: ("switched_on", "switched_off")}


def read_output(entries: Entries, key: str) -> HandleOutput | None:
    """Of HANDLE_KEY or EXTENDER_KEY; None when the profile declares none, ConnectionFailed says what is wrong."""
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
    return handle_output(message, entries.signal(message, table["signal"]), table[active], table[idle])
