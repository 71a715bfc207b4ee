"""Detects contradicting definitions of messages and signals of one name, and of messages of one identifier."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Any, Iterator, Sequence

from .codec import occupied, pages, reading

# Beginning of the fault of contradicting definitions of one name.
REPEATED = "it is there more than once"
_DIFFERENT = f"{REPEATED}, with different definitions"
# Maximum number of identifiers of one message in a sentence.
_MAX_LISTED = 4


def join_pages(messages: Sequence[Any]) -> None:
    """Merge a signal that several pages of one multiplexer repeat in the same bits: it gets the values of all these
    pages.

    SYM and KCD list a signal once per page; of several signals of one name only one is read.
    """
    for message in messages:
        for _, same in _several(message.signals):
            bodies = {(*reading(each)[:-1], each.multiplexer_ids is None) for each in same}
            if len(bodies) == 1 and same[0].multiplexer_ids is not None:
                values = sorted({value for each in same for value in each.multiplexer_ids})
                for each in same:
                    each.multiplexer_ids = values


def contradictions(messages: Sequence[Any]) -> tuple[dict[str, str], dict[tuple[str, str], str]]:
    """Return faults of messages by name, and of signals by message and name: several definitions that differ."""
    found = {name: _difference(same) for name, same in _several(messages) if len({_facts(each) for each in same}) > 1}
    return found, {(message.name, name): _DIFFERENT for message in messages
                   for name, same in _several(message.signals) if len({reading(each) for each in same}) > 1}


def contradicting(message: Any, name: str, messages: Sequence[Any]) -> Any | None:
    """Return another message with this identifier that defines a signal or its multiplexers differently, or None.

    Live link and logs decode every frame with the identifier as the named message. That is correct for a message that
    is listed under a second name, or that describes other bits of the same frame, as some tools split long messages.
    """
    others = [each for each in messages if each.name != message.name and _frame(each) == _frame(message)]
    if not others:
        return None
    own = [message.get_signal_by_name(name), *(multiplexer for multiplexer, _ in pages(message, name))]
    return next((other for other in others if any(_differs(signal, other) for signal in own)), None)


def _several(named: Sequence[Any]) -> Iterator[tuple[str, list[Any]]]:
    by_name: dict[str, list[Any]] = collections.defaultdict(list)
    for each in named:
        by_name[each.name].append(each)
    return ((name, same) for name, same in by_name.items() if len(same) > 1)


def _facts(message: Any) -> tuple[Any, ...]:
    """Return the properties in which messages of one name must agree; the bus does not count, because an adapter is on
    one."""
    signals = frozenset((signal.name, *reading(signal)) for signal in message.signals)
    return message.frame_id, message.is_extended_frame, message.length, signals


def _difference(messages: Sequence[Any]) -> str:
    identifiers = sorted({message.frame_id for message in messages})
    if len(identifiers) > 1:
        listed = ", ".join(f"{each:#x}" for each in identifiers[:_MAX_LISTED])
        return f"{REPEATED}, with the identifiers {listed}{' and more' if len(identifiers) > _MAX_LISTED else ''}"
    if len({message.bus_name for message in messages}) > 1:
        return f"{_DIFFERENT} on several buses; leave only the bus of the profile in the database"
    return _DIFFERENT


def _frame(message: Any) -> tuple[Any, ...]:
    """Return the properties that distinguish frames of messages; KCD and ARXML describe several buses in one file."""
    return message.frame_id, message.is_extended_frame, message.bus_name


def _differs(signal: Any, other: Any) -> bool:
    """Return True if another message has the signal elsewhere, or uses its bits for a signal of another name."""
    same = [each for each in other.signals if each.name == signal.name]
    if same:
        return all(reading(each) != reading(signal) for each in same)
    bits = occupied(signal)
    return any(bits & occupied(each) for each in other.signals)
