"""Profile of a car: the signal and message of its CAN database that carry the state of the locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, NamedTuple

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockFacts, LockState
from mtr_operator.storage.plain_yaml import BadYaml, load_yaml

from .database.codec import SignalReader
from .database.faults import one_line
from .further.counting import CountRange
from .further.declared import KEYS, VALUES_OF, Further, read_further
from .further.entries import FIRST_BUS, MAX_TEXT, PROFILE_FOLDER, Entries, has_long_text, is_file
from .further.state_entries import (
    LIVENESS,
    ONLY_ON_CHANGE,
    WITNESSES,
    driver_only,
    sending,
    signal_names,
    sources,
    witnesses,
)
from .outputs.declared import EXTENDER_KEY, HANDLE_KEY, DeclaredOutput, read_output
from .phone.address import FeedAddress
from .phone.car_signal import KEY as PHONE
from .phone.car_signal import PhoneSignal, read_phone
from .uds.declared import UdsPoll, read_poll, response_message

_MAX_CYCLE_S = 10.0
_CYCLE = "cycle_time_s"
_REQUIRED = ("database", "message", "signal", "states", _CYCLE)
# A polled state has no message; a database may still supply the Car's further signals.
_REQUIRED_OF_POLL = ("uds_poll", "states")
_OPTIONAL = ("description", "sent_on_change", "source_signal", "sources", ONLY_ON_CHANGE, LIVENESS, *WITNESSES,
             *VALUES_OF.values(), "min_state_s", "relock_after_s", HANDLE_KEY, EXTENDER_KEY, *KEYS, "uds_poll", PHONE)
# Motors of door locks need some tenths of a second; a shorter state is a glitch.
_MIN_STATE_S = 0.1
# Two further frames must confirm a change, to distinguish it from a glitch of one frame.
_CONFIRMING_CYCLES = 2.0
_MAX_RELOCK_S = 3600.0
# Separator of the names of signals that define a state together.
_AND = "+"


class LockReading(NamedTuple):
    """Content of one frame. source: of the last change, empty if unknown.

    raw: value of the state's signal. alive, commands, changed: see CarProfile, None if it declares no such signal.
    source_raw: value of the source's signal, None without one. doors: the unlocked ones if only some are; else empty.
    """

    state: LockState
    source: str = ""
    raw: int = 0
    alive: int | None = None
    commands: int | None = None
    changed: bool | None = None
    source_raw: int | None = None
    doors: str = ""


Decode = Callable[[int, bool, bytes], "LockReading | None"]


@dataclass(frozen=True, eq=False)
class CarProfile:
    """Profile of one car.

    states: raw values of the signal; a value that is not listed is an unknown state.
    cycle_time_s: period of the message. sent_on_change: it is also sent at once when the state changes. source_signal:
    signal of the same message with the cause of a lock change, empty without one.
    sources: its raw values; one that is not listed is an unknown source.
    alive_signal: signal that counts the frames of the message. command_signal: signal that counts accepted commands, so
    that a change comes with one. changed_signal: flag that begins with each change. The counters wrap; each name is
    empty without such a signal.
    min_state_s: shortest time between two changes. relock_after_s: time after which the car relocks if it was unlocked
    and not opened, None if it does not.
    handle_output: message to an actuator that pulls the handle, extender_output: message that switches an extender;
    None if a person has to.
    message_names: of all messages of the database, by identifier and is_extended.
    door_signals: one for each door, by its name, if they define the state together; signal then joins all their names.
    driver_only: raw values with which only the driver's door is unlocked.
    further: signals of other messages. poll: query of the state, None if the Car sends it.
    phone: source of a phone's distance, None without it.
    is_only_on_change: the message is sent only on change; cycle_time_s is then the period of liveness, a message of the
    same bus whose silence is reported. liveness is None if any frame proves that the bus is alive. count_ranges: of
    counters in the message of the state, by their names.
    """

    name: str
    description: str
    message: Any
    signal: str
    states: dict[int, LockState]
    cycle_time_s: float
    sent_on_change: bool
    source_signal: str
    sources: dict[int, str]
    alive_signal: str = ""
    command_signal: str = ""
    changed_signal: str = ""
    min_state_s: float = _MIN_STATE_S
    relock_after_s: float | None = None
    handle_output: DeclaredOutput | None = None
    message_names: Mapping[tuple[int, bool], str] = field(default_factory=dict)
    door_signals: Mapping[str, str] = field(default_factory=dict)
    driver_only: frozenset[int] = frozenset()
    further: Further = field(default_factory=Further)
    poll: UdsPoll | None = None
    phone: PhoneSignal | FeedAddress | None = None
    extender_output: DeclaredOutput | None = None
    count_ranges: Mapping[str, CountRange] = field(default_factory=dict)
    is_only_on_change: bool = False
    liveness: Any = None

    @property
    def facts(self) -> LockFacts:
        """Facts about the locks that a scenario needs."""
        # A change that a second signal confirms needs no second frame.
        is_vouched = bool(self.command_signal or self.changed_signal or self.further.counters)
        cycles_s = 0.0 if self.is_only_on_change else _CONFIRMING_CYCLES * self.cycle_time_s
        confirm_s = 0.0 if is_vouched else max(self.min_state_s, cycles_s)
        return LockFacts(frozenset(self.sources.values()) | self.further.sources, self.relock_after_s, confirm_s,
                         0.0 if self.sent_on_change else self.cycle_time_s, self.further.settles_s,
                         self.further.is_required)

    @property
    def identifiers(self) -> dict[str, tuple[int, bool]]:
        """Identifier and is_extended, by the names of the messages of all buses."""
        further = {place.message.name: place.key[1:] for place in self.further.places()}
        return {**further, **{name: key for key, name in self.message_names.items()}}

    def counts(self, signal: str) -> CountRange:
        """Return the range of a counter in the state's message."""
        length = self.message.get_signal_by_name(signal).length
        return self.count_ranges.get(signal, CountRange(0, (1 << length) - 1, length))

    def is_message(self, can_id: int, is_extended: bool) -> bool:
        """Return True for frames of the message of the state."""
        return bool(can_id == self.message.frame_id and is_extended == self.message.is_extended_frame)

    def is_alive(self, can_id: int, is_extended: bool) -> bool:
        """Return True for frames whose silence is reported: of the state, or of its liveness message, which may be any
        frame."""
        message = self.liveness if self.is_only_on_change else self.message
        return message is None or bool(can_id == message.frame_id and is_extended == message.is_extended_frame)

    def decoder(self) -> Decode:
        """Return a decoder of frames in their order; for a polled state it decodes the answers."""
        return self.decode if self.poll is None else self.poll.decoder(self.reading)

    def decode(self, can_id: int, is_extended: bool, data: bytes) -> LockReading | None:
        """Return the content of a frame; None if it is a different message, too short, or a different multiplex
        page."""
        return self._decode_data(data) if self.is_message(can_id, is_extended) else None

    def reading(self, raw: int) -> LockReading:
        """Return the reading of a polled value."""
        return LockReading(self.states.get(raw, LockState.UNKNOWN), raw=raw, doors=self._driver(raw))

    def _driver(self, raw: int) -> str:
        return "driver" if raw in self.driver_only else ""

    @functools.cached_property
    def _reader(self) -> SignalReader:
        named = (self.source_signal, self.alive_signal, self.command_signal, self.changed_signal)
        return SignalReader(self.message, {*named, *(self.door_signals.values() or (self.signal,))} - {""})

    # The same few frames repeat continuously.
    @functools.lru_cache(maxsize=1024)  # noqa: B019
    def _decode_data(self, data: bytes) -> LockReading | None:
        values = self._reader.values(data)
        state = self._state(values)
        if state is None:
            return None
        changed, source_raw = values.get(self.changed_signal), values.get(self.source_signal)
        return state._replace(source="" if source_raw is None else self.sources.get(source_raw, ""),
                              alive=values.get(self.alive_signal),
                              commands=values.get(self.command_signal),
                              changed=None if changed is None else bool(changed), source_raw=source_raw)

    def _state(self, values: Mapping[str, Any]) -> LockReading | None:
        """Return the reading of one signal, or of all doors together; None if the frame contains none."""
        if not self.door_signals:
            raw = values.get(self.signal)
            return None if raw is None else self.reading(raw)
        raws = {door: values.get(signal) for door, signal in self.door_signals.items()}
        if any(raw is None for raw in raws.values()):
            return None
        states = {door: self.states.get(raw, LockState.UNKNOWN) for door, raw in raws.items() if raw is not None}
        unknown = next((raw for door, raw in raws.items() if states[door] is LockState.UNKNOWN), None)
        if unknown is not None:
            return LockReading(LockState.UNKNOWN, raw=unknown)
        unlocked = [door for door, state in states.items() if state is LockState.UNLOCKED]
        doors = ", ".join(unlocked) if len(unlocked) < len(states) else ""
        return LockReading(LockState.UNLOCKED if unlocked else LockState.LOCKED, raw=len(unlocked), doors=doors)


def load_profile(name_or_path: str, databases: pathlib.Path | None = None) -> CarProfile:
    """Load a shipped profile by its name, or a YAML file by its path; ConnectionFailed states a fault.

    databases: folder of its databases; by default the profile's folder, then MTR_CAR_DATABASES.
    """
    path = _find(name_or_path)
    entries = Entries(path, _read(path), databases)
    return _polled(path, entries) if "uds_poll" in entries.content else _sent(path, entries)


def _sent(path: pathlib.Path, entries: Entries) -> CarProfile:
    """Load the profile of a Car that sends its state."""
    content = entries.content
    message = entries.message(content["message"])
    names = signal_names(entries, message)
    signals = [message.get_signal_by_name(name) for name in names.values()]
    states = entries.states_of(signals)
    sent = sending(entries, message)
    has_sources = "sources" in content
    return CarProfile(
        name=path.stem, description=str(content.get("description", "")), message=message,
        signal=_AND.join(names.values()), door_signals=names if isinstance(content["signal"], dict) else {},
        states=states,
        driver_only=frozenset().union(*(entries.decoded(raw, signals) for raw in driver_only(content))),
        source_signal=entries.signal(message, content["source_signal"]) if has_sources else "",
        sources=sources(entries, message) if has_sources else {},
        **sent, **witnesses(entries, message), **_common(entries, message, sent["cycle_time_s"]))


def _polled(path: pathlib.Path, entries: Entries) -> CarProfile:
    """Load the profile of a Car that is polled for its state."""
    content, poll = entries.content, read_poll(entries)
    message = response_message(poll)
    return CarProfile(
        name=path.stem, description=str(content.get("description", "")), message=message, signal=poll.name,
        states=entries.states(content["states"]), driver_only=driver_only(content), cycle_time_s=poll.every_s,
        sent_on_change=False, source_signal="", sources={}, poll=poll, **_common(entries, message, poll.every_s))


def _common(entries: Entries, message: Any, cycle_time_s: float) -> dict[str, Any]:
    content = entries.content
    names = {} if "database" not in content else {
        (each.frame_id, each.is_extended_frame): each.name for each in entries.database().messages}
    return {"min_state_s": entries.duration("min_state_s", (0.0, _MAX_CYCLE_S), _MIN_STATE_S),
            "relock_after_s": entries.duration("relock_after_s", (1.0, _MAX_RELOCK_S)),
            "handle_output": read_output(entries, HANDLE_KEY), "extender_output": read_output(entries, EXTENDER_KEY),
            "message_names": names, "further": read_further(entries, message, cycle_time_s),
            "phone": read_phone(entries)}


def profile_files(name_or_path: str) -> tuple[pathlib.Path, ...]:
    """Return the paths of the profile and its databases; ConnectionFailed if the profile does not exist."""
    path = _find(name_or_path)
    entries = Entries(path, _read(path))
    buses = (*((FIRST_BUS,) if "database" in entries.content else ()), *entries.buses)
    return path, *(entries.database_path(bus) for bus in buses)


def bundled_files(name_or_path: str) -> tuple[dict[str, pathlib.Path], dict[str, str]]:
    """Return the files of a profile that a bundle may contain, and the reasons for omitting others, by their names.
    ConnectionFailed if the profile does not exist."""
    path = _find(name_or_path)
    files, left_out = Entries(path, _read(path)).usable_databases()
    return {path.name: path, **files}, left_out


def bus_names(name_or_path: str) -> tuple[str, ...]:
    """Return the names of the further buses, in their order; ConnectionFailed if the profile is missing or faulty."""
    path = _find(name_or_path)
    return Entries(path, _read(path)).buses


def profile_names() -> tuple[str, ...]:
    """Names of the shipped profiles."""
    return tuple(sorted(file.stem for file in PROFILE_FOLDER.glob("*.yaml")))


def _find(name_or_path: str) -> pathlib.Path:
    shipped = PROFILE_FOLDER / f"{name_or_path}.yaml"
    if shipped.parent == PROFILE_FOLDER and is_file(shipped):
        return shipped
    path = pathlib.Path(name_or_path)
    if is_file(path):
        return path
    names = ", ".join(profile_names())
    raise ConnectionFailed(f"There is no car profile {name_or_path}; shipped are: {names}; "
                           "a path to a YAML file works too.")


def _read(path: pathlib.Path) -> dict[str, Any]:
    try:
        content = load_yaml(path)
    except OSError as error:
        raise ConnectionFailed(f"Car profile {path} cannot be read: {one_line(error)}.") from None
    except BadYaml as error:
        raise ConnectionFailed(f"Car profile {path} {error}; a profile is a YAML file that names the CAN "
                               "database.") from None
    if not isinstance(content, dict):
        raise ConnectionFailed(f"Car profile {path} is no table of names and values.")
    if has_long_text(content):
        raise ConnectionFailed(f"Car profile {path} has a text of more than {MAX_TEXT} characters.")
    for key in content:
        if key not in _REQUIRED + _OPTIONAL:
            raise ConnectionFailed(f"Car profile {path}: unknown entry {key}; allowed are "
                                   f"{', '.join(_REQUIRED + _OPTIONAL)}.")
    for key in _REQUIRED_OF_POLL if "uds_poll" in content else _REQUIRED:
        if key not in content and not (key == _CYCLE and content.get(ONLY_ON_CHANGE) is True):
            raise ConnectionFailed(f"Car profile {path} lacks the entry {key}.")
    _check_pairs(path, content)
    return content


def _check_pairs(path: pathlib.Path, content: Mapping[str, Any]) -> None:
    for key, values in VALUES_OF.items():
        if values in content and key not in content:
            raise ConnectionFailed(f"Car profile {path}: {values} belongs to {key}, which is missing.")
    if ("source_signal" in content) != ("sources" in content):
        raise ConnectionFailed(f"Car profile {path}: source_signal and sources belong together; give both or none.")
