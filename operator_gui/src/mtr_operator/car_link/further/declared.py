"""Further signals that a car's profile declares in addition to the lock state: of any message on any of its buses."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Iterator

from mtr_operator.domain.ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY

from .counting import count_range
from .entries import FIRST_BUS, Entries, is_whole
from .places import Place
from .stop_signals import KEY as STOP_KEY
from .stop_signals import PLACE_KEYS, StopSignal, stop_signal, stop_tables

SOURCES = (PASSIVE_ENTRY, KEY_BUTTON, HANDLE)
# A body ECU reports a cause within some cycles of the change; a person needs longer for a second action.
_WITHIN_S = 0.5
_WITHIN_CYCLES = 2.0
_MAX_WITHIN_S = 10.0
_CAUSE_KEYS = {"bus", "message", "signal", "sources", "idle", "stays"}
_DOOR_KEYS = {"bus", "message", "signal", "open"}
_KEY_KEYS = {"bus", "message", "signal", "under_test"}
_COUNTER_KEYS = {"bus", "message", "signal", "values"}
KEYS = ("buses", "causes", "cause_within_s", "cause_required", "doors", "key_number", STOP_KEY)

# Entry with the values of a counter, by the entry with the counter.
VALUES_OF = {"alive_signal": "alive_values", "command_signal": "command_values"}


@dataclass(frozen=True, eq=False)
class CauseSignal:
    """Signal with the cause of a lock change. sources: by raw value. idle: values without information. stays: the value
    stays until the next change, so only values after a change belong to it; otherwise it is set briefly around it."""

    place: Place
    sources: dict[int, str]
    idle: frozenset[int]
    stays: bool


@dataclass(frozen=True, eq=False)
class DoorSignal:
    """Signal of a door. open: raw values of an open door."""

    name: str
    place: Place
    open: frozenset[int]


@dataclass(frozen=True, eq=False)
class Further:
    """All further signals of a profile.

    within_s: time before and after a change for the signals that belong to it. is_required: a change without a listed
    cause is invalid. key: number of the key that moved the locks; key_under_test: its value, None for any key.
    counters: of changes or commands; alive: of the frames of their messages. buses: further ones, in the log's order.
    stops: signals that stop the robot, in addition to the doors.
    """

    causes: tuple[CauseSignal, ...] = ()
    within_s: float = _WITHIN_S
    is_required: bool = False
    key: Place | None = None
    key_under_test: int | None = None
    counters: tuple[Place, ...] = ()
    alive: tuple[Place, ...] = ()
    doors: tuple[DoorSignal, ...] = ()
    buses: tuple[str, ...] = field(default=())
    stops: tuple[StopSignal, ...] = ()

    @property
    def sources(self) -> frozenset[str]:
        """All causes that the signals can name."""
        return frozenset(source for cause in self.causes for source in cause.sources.values())

    @property
    def settles_s(self) -> float:
        """Time after a change until its facts are complete."""
        return self.within_s if self.causes or self.counters or self.key else 0.0

    def places(self) -> Iterator[Place]:
        """Yield all signals."""
        yield from (cause.place for cause in self.causes)
        yield from (door.place for door in self.doors)
        yield from (stop.place for stop in self.stops)
        yield from (*self.counters, *self.alive, *((self.key,) if self.key else ()))


def read_further(entries: Entries, first_message: Any, cycle_s: float) -> Further:
    """Read the further signals of a profile; ConnectionFailed states a fault. first_message: message of the state."""
    content, buses = entries.content, entries.buses
    reader = _Reader(entries, first_message)
    key = content.get("key_number")
    return Further(
        causes=tuple(reader.cause(each) for each in _list(entries, "causes")),
        within_s=entries.duration("cause_within_s", (0.0, _MAX_WITHIN_S), max(_WITHIN_S, _WITHIN_CYCLES * cycle_s)),
        is_required=entries.flag("cause_required"),
        key=None if key is None else reader.place("key_number", key, _KEY_KEYS),
        key_under_test=None if key is None else reader.whole("key_number", key, "under_test"),
        counters=reader.elsewhere("command_signal"), alive=reader.elsewhere("alive_signal"),
        doors=tuple(reader.door(name, each) for name, each in _doors(entries).items()), buses=buses,
        stops=tuple(reader.stop(kind, each) for kind, each in stop_tables(entries).items()))


def is_elsewhere(entry: Any) -> bool:
    """Return True for a signal of another message, which is a table; a signal of the state's message is a name."""
    return isinstance(entry, dict)


def _list(entries: Entries, key: str) -> list[Any]:
    found = entries.content.get(key, [])
    if not isinstance(found, list):
        raise entries.wrong(f"{key} must be a list of tables.")
    return found


def _doors(entries: Entries) -> dict[str, Any]:
    table = entries.content.get("doors", {})
    if not isinstance(table, dict) or not all(isinstance(name, str) for name in table):
        raise entries.wrong("doors must be a table from the name of a door to its signal.")
    return table


class _Reader:
    def __init__(self, entries: Entries, first_message: Any):
        self._entries = entries
        self._first = first_message

    def place(self, key: str, table: Any, allowed: set[str]) -> Place:
        """Return a signal of the state's message, or of another one."""
        if not isinstance(table, dict) or "signal" not in table or not set(table) <= allowed:
            raise self._entries.wrong(f"{key} must be a table of {', '.join(sorted(allowed))}.")
        bus = table.get("bus", FIRST_BUS)
        if bus != FIRST_BUS and bus not in self._entries.buses:
            raise self._entries.wrong(f"{key} names the bus {bus}, which is not in buses.")
        if bus != FIRST_BUS and "message" not in table:
            raise self._entries.wrong(f"{key} is on the bus {bus} and names no message.")
        message = self._entries.message(table["message"], bus) if "message" in table else self._first
        return Place(bus, message, self._entries.signal(message, table["signal"], bus))

    def elsewhere(self, key: str) -> tuple[Place, ...]:
        """Return the signal of a counter outside the state's message; empty without one."""
        table = self._entries.content.get(key)
        if not isinstance(table, dict):
            return ()
        place = self.place(key, table, _COUNTER_KEYS)
        values = table.get("values", self._entries.content.get(VALUES_OF[key]))
        return (replace(place, values=count_range(self._entries, VALUES_OF[key], values, place.declared)),)

    def cause(self, table: Any) -> CauseSignal:
        """Return an item of the entry causes."""
        place = self.place("causes", table, _CAUSE_KEYS)
        sources = self._entries.decoded_words(
            "sources", self._entries.words("sources", table.get("sources"), SOURCES), (place.declared,))
        idle = self._values("causes", table, "idle", () if 0 in sources else (0,), place)
        return CauseSignal(place, sources, idle - set(sources), bool(table.get("stays", False)))

    def door(self, name: str, table: Any) -> DoorSignal:
        """Return an item of the entry doors."""
        place = self.place("doors", table, _DOOR_KEYS)
        return DoorSignal(name, place, self._values("doors", table, "open", (1,), place))

    def stop(self, kind: str, table: dict[str, Any]) -> StopSignal:
        """Return an item of the entry stop_signals."""
        place = self.place(STOP_KEY, {name: table[name] for name in PLACE_KEYS & set(table)}, PLACE_KEYS)
        return stop_signal(self._entries, kind, table, place)

    def whole(self, key: str, table: dict[str, Any], name: str) -> int | None:
        """Return a whole number, None if absent."""
        value = table.get(name)
        if value is not None and not is_whole(value):
            raise self._entries.wrong(f"{key} has {name}: {value!r}; allowed is a whole number.")
        return value

    def _values(self, key: str, table: dict[str, Any], name: str, default: tuple[int, ...],
                place: Place) -> frozenset[int]:
        values = table.get(name, list(default))
        if not isinstance(values, list) or not all(is_whole(value) for value in values):
            raise self._entries.wrong(f"{key} has {name}: {values!r}; allowed is a list of whole numbers.")
        return frozenset().union(*(self._entries.decoded(value, (place.declared,))
                                   for value in values))
