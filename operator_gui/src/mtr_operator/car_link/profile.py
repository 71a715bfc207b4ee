"""Profile of a car: which signal of which message of its CAN database tells the state of the locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass
from typing import Any, Mapping, NamedTuple

import cantools

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, LockState
from mtr_operator.storage.plain_yaml import BadYaml, load_yaml

PROFILE_FOLDER = pathlib.Path(__file__).parent / "profiles"
_MIN_CYCLE_S = 0.001
_MAX_CYCLE_S = 10.0
# Databases of a whole car have some megabytes; reading one takes the library ten seconds and more.
_MAX_DATABASE_BYTES = 16 * 1024 * 1024
_REQUIRED = ("database", "message", "signal", "states", "cycle_time_s")
_OPTIONAL = ("description", "sent_on_change", "source_signal", "sources")
_STATES = {state.value: state for state in LockState}
_SOURCES = {source: source for source in (PASSIVE_ENTRY, KEY_BUTTON)}


class LockReading(NamedTuple):
    """What one frame says. source: of the last change, empty when it is not known."""

    state: LockState
    source: str = ""


@dataclass(frozen=True, eq=False)
class CarProfile:
    """One car.

    states: raw values of the signal; a value that is not listed is an unknown state.
    cycle_time_s: period of the message. sent_on_change: it is also sent at once when the state changes.
    source_signal: signal of the same message that tells what made the locks move, empty when there is none.
    sources: its raw values; one that is not listed is an unknown source.
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
        source = self.sources.get(values.get(self.source_signal), "")
        return LockReading(self.states.get(value, LockState.UNKNOWN), source)


def load_profile(name_or_path: str) -> CarProfile:
    """Profile by the name of a shipped one or by the path of a YAML file; ConnectionFailed says what is wrong."""
    path = _find(name_or_path)
    content = _read(path)
    states = _table(path, content, "states", _STATES)
    if not {LockState.LOCKED, LockState.UNLOCKED} <= set(states.values()):
        raise ConnectionFailed(f"Car profile {path}: states must name a value for locked and one for unlocked.")
    message = _message(path, content)
    return CarProfile(
        name=path.stem, description=str(content.get("description", "")), message=message,
        signal=_signal(path, content, "signal", message), states=states, cycle_time_s=_cycle_time(path, content),
        sent_on_change=bool(content.get("sent_on_change", False)),
        source_signal=_signal(path, content, "source_signal", message) if "sources" in content else "",
        sources=_table(path, content, "sources", _SOURCES) if "sources" in content else {})


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


def _cycle_time(path: pathlib.Path, content: dict[str, Any]) -> float:
    cycle_s = content["cycle_time_s"]
    if isinstance(cycle_s, bool) or not isinstance(cycle_s, (int, float)) \
            or not _MIN_CYCLE_S <= cycle_s <= _MAX_CYCLE_S:
        raise ConnectionFailed(f"Car profile {path}: cycle_time_s is {cycle_s}; allowed is {_MIN_CYCLE_S:g} to "
                               f"{_MAX_CYCLE_S:g} s.")
    return float(cycle_s)


def _message(path: pathlib.Path, content: dict[str, Any]) -> Any:
    database_path = path.parent / str(content["database"])
    try:
        if database_path.stat().st_size > _MAX_DATABASE_BYTES:
            raise ConnectionFailed(f"CAN database {database_path} is larger than {_MAX_DATABASE_BYTES // 1024} KiB; "
                                   "leave the messages that the profile does not name out of it.")
        database = cantools.database.load_file(str(database_path), strict=False)
        if not isinstance(database, cantools.database.can.Database):
            raise KeyError(content["message"])
        return database.get_message_by_name(str(content["message"]))
    except KeyError:
        raise ConnectionFailed(f"CAN database {database_path} has no message {content['message']}.") from None
    except (OSError, UnicodeDecodeError, cantools.database.errors.Error) as error:
        raise ConnectionFailed(f"CAN database {database_path} cannot be read: {_one_line(error)}.") from None
    # The library's readers of some five formats raise whatever a damaged file leads them to.
    except (ValueError, TypeError, AttributeError, LookupError, ArithmeticError, RecursionError):
        raise ConnectionFailed(f"CAN database {database_path} cannot be read: it is damaged.") from None


def _signal(path: pathlib.Path, content: dict[str, Any], key: str, message: Any) -> str:
    signal = str(content[key])
    if signal not in (known.name for known in message.signals):
        database_path = path.parent / str(content["database"])
        raise ConnectionFailed(f"Message {message.name} of CAN database {database_path} has no signal {signal}.")
    return signal


def _one_line(error: Exception) -> str:
    return " ".join((getattr(error, "strerror", None) or str(error)).split()).rstrip(".")
