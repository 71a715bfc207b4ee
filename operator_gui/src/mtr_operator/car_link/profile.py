"""Profile of a car: which signal of which message of its CAN database tells the state of the locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass, field
from typing import Any, Mapping, NamedTuple

import cantools

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY, LockFacts, LockState
from mtr_operator.storage.plain_yaml import BadYaml, load_yaml

from .handle import HandleOutput, handle_output

PROFILE_FOLDER = pathlib.Path(__file__).parent / "profiles"
_MIN_CYCLE_S = 0.001
_MAX_CYCLE_S = 10.0
# Databases of a whole car have some megabytes; reading one takes the library ten seconds and more.
_MAX_DATABASE_BYTES = 16 * 1024 * 1024
_REQUIRED = ("database", "message", "signal", "states", "cycle_time_s")
_WITNESSES = ("alive_signal", "command_signal", "changed_signal")
_OPTIONAL = ("description", "sent_on_change", "source_signal", "sources", *_WITNESSES, "min_state_s", "relock_after_s",
             "handle_request")
_HANDLE_KEYS = ("message", "signal", "taken", "released")
# Motors of door locks need some tenths of a second; a state that is over sooner was none.
_MIN_STATE_S = 0.1
# A change is shown by two frames more before a glitch of one frame can be told from it.
_CONFIRMING_CYCLES = 2.0
_MAX_RELOCK_S = 3600.0
_STATES = {state.value: state for state in LockState}
_SOURCES = {source: source for source in (PASSIVE_ENTRY, KEY_BUTTON, HANDLE)}


class LockReading(NamedTuple):
    """What one frame says. source: of the last change, empty when it is not known.

    raw: value of the state's signal. alive, commands, changed: see CarProfile, None when it declares no such signal.
    """

    state: LockState
    source: str = ""
    raw: int = 0
    alive: int | None = None
    commands: int | None = None
    changed: bool | None = None


@dataclass(frozen=True, eq=False)
class CarProfile:
    """One car.

    states: raw values of the signal; a value that is not listed is an unknown state.
    cycle_time_s: period of the message. sent_on_change: it is also sent at once when the state changes.
    source_signal: signal of the same message that tells what made the locks move, empty when there is none.
    sources: its raw values; one that is not listed is an unknown source.
    alive_signal: signal that counts the frames of the message. command_signal: signal that counts accepted commands, so
    that a change comes with one. changed_signal: flag that begins with each change. Each wraps, and is empty when there
    is none.
    min_state_s: shortest time between two changes. relock_after_s: time after which the car locks by itself when it was
    unlocked and not opened, None when it does not.
    handle_output: the message that has an actuator take the handle, None when a person has to.
    message_names: of all messages of the database, by identifier and whether it is an extended one.
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
    handle_output: HandleOutput | None = None
    message_names: Mapping[tuple[int, bool], str] = field(default_factory=dict)

    @property
    def facts(self) -> LockFacts:
        """What a scenario has to know of it."""
        # A change that a second signal vouches for needs no second frame.
        is_vouched = bool(self.command_signal or self.changed_signal)
        confirm_s = 0.0 if is_vouched else max(self.min_state_s, _CONFIRMING_CYCLES * self.cycle_time_s)
        return LockFacts(frozenset(self.sources.values()), self.relock_after_s, confirm_s,
                         0.0 if self.sent_on_change else self.cycle_time_s)

    def modulus(self, signal: str) -> int:
        """How many values a counter has."""
        return 1 << int(self.message.get_signal_by_name(signal).length)

    def decode(self, can_id: int, is_extended: bool, data: bytes) -> LockReading | None:
        """What a frame says; None when the frame is another message, too short, or of another multiplex page."""
        if can_id != self.message.frame_id or is_extended != self.message.is_extended_frame:
            return None
        return self._decode_data(data)

    # The same few frames repeat for ever.
    @functools.lru_cache(maxsize=1024)  # noqa: B019
    def _decode_data(self, data: bytes) -> LockReading | None:
        try:
            values = self.message.decode(data, decode_choices=False, scaling=False)
        except (cantools.database.DecodeError, ValueError):
            return None
        value = values.get(self.signal)
        if value is None:
            return None
        changed = values.get(self.changed_signal)
        return LockReading(self.states.get(value, LockState.UNKNOWN),
                           self.sources.get(values.get(self.source_signal), ""), value, values.get(self.alive_signal),
                           values.get(self.command_signal), None if changed is None else bool(changed))


def load_profile(name_or_path: str) -> CarProfile:
    """Profile by the name of a shipped one or by the path of a YAML file; ConnectionFailed says what is wrong."""
    path = _find(name_or_path)
    content = _read(path)
    states = _table(path, content, "states", _STATES)
    if not {LockState.LOCKED, LockState.UNLOCKED} <= set(states.values()):
        raise ConnectionFailed(f"Car profile {path}: states must name a value for locked and one for unlocked.")
    database = _database(path, content["database"])
    message = _message(path, content, database, content["message"])
    return CarProfile(
        name=path.stem, description=str(content.get("description", "")), message=message,
        signal=_signal(path, content, "signal", message), states=states,
        cycle_time_s=_duration(path, content, "cycle_time_s", (_MIN_CYCLE_S, _MAX_CYCLE_S)),
        sent_on_change=bool(content.get("sent_on_change", False)),
        source_signal=_signal(path, content, "source_signal", message) if "sources" in content else "",
        sources=_table(path, content, "sources", _SOURCES) if "sources" in content else {},
        **{key: _signal(path, content, key, message) for key in _WITNESSES if key in content},
        min_state_s=_duration(path, content, "min_state_s", (0.0, _MAX_CYCLE_S), _MIN_STATE_S),
        relock_after_s=_duration(path, content, "relock_after_s", (1.0, _MAX_RELOCK_S)),
        handle_output=_handle_output(path, content, database) if "handle_request" in content else None,
        message_names={(each.frame_id, each.is_extended_frame): each.name for each in database.messages})


def profile_files(name_or_path: str) -> tuple[pathlib.Path, pathlib.Path]:
    """The profile and its database; ConnectionFailed when there is no such profile."""
    path = _find(name_or_path)
    return path, path.parent / str(_read(path)["database"])


def profile_names() -> tuple[str, ...]:
    """Names of the shipped profiles."""
    return tuple(sorted(file.stem for file in PROFILE_FOLDER.glob("*.yaml")))


def _find(name_or_path: str) -> pathlib.Path:
    shipped = PROFILE_FOLDER / f"{name_or_path}.yaml"
    if shipped.parent == PROFILE_FOLDER and shipped.is_file():
        return shipped
    path = pathlib.Path(name_or_path)
    if path.is_file():
        return path
    names = ", ".join(profile_names())
    raise ConnectionFailed(f"There is no car profile {name_or_path}; shipped are: {names}; "
                           "a path to a YAML file works too.")


def _read(path: pathlib.Path) -> dict[str, Any]:
    try:
        content = load_yaml(path)
    except OSError as error:
        raise ConnectionFailed(f"Car profile {path} cannot be read: {_one_line(error)}.") from None
    except BadYaml as error:
        raise ConnectionFailed(f"Car profile {path} {error}; a profile is a YAML file that names the CAN "
                               "database.") from None
    if not isinstance(content, dict):
        raise ConnectionFailed(f"Car profile {path} is no table of names and values.")
    for key in content:
        if key not in _REQUIRED + _OPTIONAL:
            raise ConnectionFailed(f"Car profile {path}: unknown entry {key}; allowed are "
                                   f"{', '.join(_REQUIRED + _OPTIONAL)}.")
    for key in _REQUIRED:
        if key not in content:
            raise ConnectionFailed(f"Car profile {path} lacks the entry {key}.")
    if ("source_signal" in content) != ("sources" in content):
        raise ConnectionFailed(f"Car profile {path}: source_signal and sources belong together; give both or none.")
    return content


def _table(path: pathlib.Path, content: dict[str, Any], key: str, meanings: Mapping[str, Any]) -> dict[int, Any]:
    """Meaning of each raw value that the entry lists."""
    table = content[key]
    if not isinstance(table, dict):
        raise ConnectionFailed(f"Car profile {path}: {key} must be a table from raw value to {_either(meanings)}.")
    for raw, text in table.items():
        is_whole = isinstance(raw, int) and not isinstance(raw, bool)
        if not is_whole or not isinstance(text, str) or text not in meanings:
            raise ConnectionFailed(f"Car profile {path}: {key} has {raw!r}: {text!r}; allowed is a whole number with "
                                   f"{_either(meanings)}.")
    return {raw: meanings[text] for raw, text in table.items()}


def _either(words: Mapping[str, Any]) -> str:
    *others, last = words
    return f"{', '.join(others)} or {last}"


def _duration(path: pathlib.Path, content: dict[str, Any], key: str, limits_s: tuple[float, float],
              default_s: Any = None) -> Any:
    """Time in s of an entry, the default when it is absent."""
    if key not in content:
        return default_s
    time_s, (low_s, high_s) = content[key], limits_s
    if isinstance(time_s, bool) or not isinstance(time_s, (int, float)) or not low_s <= time_s <= high_s:
        raise ConnectionFailed(f"Car profile {path}: {key} is {time_s}; allowed is {low_s:g} to {high_s:g} s.")
    return float(time_s)


def _handle_output(path: pathlib.Path, content: dict[str, Any], database: Any) -> HandleOutput:
    table = content["handle_request"]
    if not isinstance(table, dict) or set(table) != set(_HANDLE_KEYS):
        raise ConnectionFailed(f"Car profile {path}: handle_request must be a table of {', '.join(_HANDLE_KEYS)}.")
    for key in ("taken", "released"):
        if not isinstance(table[key], int) or isinstance(table[key], bool):
            raise ConnectionFailed(f"Car profile {path}: handle_request has {key}: {table[key]!r}; allowed is a whole "
                                   "number.")
    if table["taken"] == table["released"]:
        raise ConnectionFailed(f"Car profile {path}: taken and released of handle_request are both {table['taken']}; "
                               "give two values.")
    message = _message(path, content, database, table["message"])
    signal = _signal(path, {**content, "signal": table["signal"]}, "signal", message)
    return handle_output(message, signal, table["taken"], table["released"])


def _message(path: pathlib.Path, content: dict[str, Any], database: Any, name: Any) -> Any:
    try:
        return database.get_message_by_name(str(name))
    except KeyError:
        database_path = path.parent / str(content["database"])
        raise ConnectionFailed(f"CAN database {database_path} has no message {name}.") from None


def _database(path: pathlib.Path, name: Any) -> Any:
    """One of CAN messages; of another kind an empty one, in which no message is found."""
    database_path = path.parent / str(name)
    try:
        if database_path.stat().st_size > _MAX_DATABASE_BYTES:
            raise ConnectionFailed(f"CAN database {database_path} is larger than {_MAX_DATABASE_BYTES // 1024} KiB; "
                                   "leave the messages that the profile does not name out of it.")
        database = cantools.database.load_file(str(database_path), strict=False)
    except (OSError, UnicodeDecodeError, cantools.database.errors.Error) as error:
        raise ConnectionFailed(f"CAN database {database_path} cannot be read: {_one_line(error)}.") from None
    # The library's readers of some five formats raise whatever a damaged file leads them to.
    except (ValueError, TypeError, AttributeError, LookupError, ArithmeticError, RecursionError):
        raise ConnectionFailed(f"CAN database {database_path} cannot be read: it is damaged.") from None
    return database if isinstance(database, cantools.database.can.Database) else cantools.database.can.Database()


def _signal(path: pathlib.Path, content: dict[str, Any], key: str, message: Any) -> str:
    signal = str(content[key])
    if signal not in (known.name for known in message.signals):
        database_path = path.parent / str(content["database"])
        raise ConnectionFailed(f"Message {message.name} of CAN database {database_path} has no signal {signal}.")
    return signal


def _one_line(error: Exception) -> str:
    return " ".join((getattr(error, "strerror", None) or str(error)).split()).rstrip(".")
