"""Entries of a profile on the message of the state: signals, counters and transmission."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping

from .counting import count_range
from .declared import SOURCES, VALUES_OF, is_elsewhere
from .entries import DRIVER_ONLY, Entries

WITNESSES = ("alive_signal", "command_signal", "changed_signal")
ONLY_ON_CHANGE, LIVENESS = "sent_only_on_change", "liveness_message"
_MIN_CYCLE_S = 0.001
_MAX_CYCLE_S = 10.0
# Expected frame interval of a live bus, if the state is sent only on change.
_BUS_CYCLE_S = 0.1


def witnesses(entries: Entries, message: Any) -> dict[str, Any]:
    """Return counters and flag of the state's own message, with the ranges of the counters."""
    content = entries.content
    names = {key: entries.signal(message, content[key]) for key in WITNESSES
             if key in content and not is_elsewhere(content[key])}
    ranges = {names[key]: count_range(entries, values, content.get(values), message.get_signal_by_name(names[key]))
              for key, values in VALUES_OF.items() if key in names}
    return {**names, "count_ranges": ranges}


def sources(entries: Entries, message: Any) -> dict[int, str]:
    """Return the causes of source_signal by raw value."""
    signal = message.get_signal_by_name(entries.signal(message, entries.content["source_signal"]))
    return entries.decoded_words("sources", entries.words("sources", entries.content["sources"], SOURCES), (signal,))


def signal_names(entries: Entries, message: Any) -> dict[str, str]:
    """Return the signal of each door; a single signal has no name."""
    signal = entries.content["signal"]
    table = signal if isinstance(signal, dict) else {"": signal}
    if not table or not all(isinstance(name, str) for name in table):
        raise entries.wrong("signal must be a name, or a table from the name of a door to its signal.")
    return {name: entries.signal(message, each) for name, each in table.items()}


def driver_only(content: Mapping[str, Any]) -> frozenset[int]:
    """Return the raw values with which only the driver's door is unlocked."""
    return frozenset(raw for raw, word in content["states"].items() if word == DRIVER_ONLY)


def sending(entries: Entries, message: Any) -> dict[str, Any]:
    """Return the fields of CarProfile on the transmission of the message."""
    is_only_on_change = entries.flag(ONLY_ON_CHANGE)
    liveness = entries.content.get(LIVENESS)
    if liveness is not None and not is_only_on_change:
        raise entries.wrong(f"{LIVENESS} belongs to {ONLY_ON_CHANGE}, which is missing or false.")
    other = None if liveness is None else entries.message(liveness)
    if other is message:
        raise entries.wrong(f"{LIVENESS} is {liveness}, which is only sent on change; name another message.")
    return {"cycle_time_s": entries.duration("cycle_time_s", (_MIN_CYCLE_S, _MAX_CYCLE_S), _BUS_CYCLE_S),
            "sent_on_change": is_only_on_change or entries.flag("sent_on_change"),
            "is_only_on_change": is_only_on_change, "liveness": other}
