"""Profile of a car: which signal of which message of its CAN database tells the state of the locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass
from typing import Any

import cantools
import yaml

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

PROFILE_FOLDER = pathlib.Path(__file__).parent / "profiles"
_SHORTEST_CYCLE_S = 0.001
_LONGEST_CYCLE_S = 10.0
_REQUIRED = ("database", "message", "signal", "states", "cycle_time_s")
_OPTIONAL = ("description", "sent_on_change")


@dataclass(frozen=True, eq=False)
class CarProfile:
    """One car.

    states: raw values of the signal; a value that is not listed is an unknown state.
    cycle_time_s: period of the message. sent_on_change: it is also sent at once when the state changes.
    """

    name: str
    description: str
    message: Any
    signal: str
    states: dict[int, LockState]
    cycle_time_s: float
    sent_on_change: bool

    def decode(self, can_id: int, is_extended: bool, data: bytes) -> LockState | None:
        """State in a frame; None when the frame is another message, too short, or of another multiplex page."""
        if can_id != self.message.frame_id or is_extended != self.message.is_extended_frame:
            return None
        return self._decode_data(data)

    # The same few frames repeat for ever.
    @functools.lru_cache(maxsize=1024)  # noqa: B019
    def _decode_data(self, data: bytes) -> LockState | None:
        try:
            values = self.message.decode(data, decode_choices=False, scaling=False)
        except (cantools.database.DecodeError, ValueError):
            return None
        value = values.get(self.signal)
        return None if value is None else self.states.get(value, LockState.UNKNOWN)


def load_profile(name_or_path: str) -> CarProfile:
    """Profile by the name of a shipped one or by the path of a YAML file; ConnectionFailed says what is wrong."""
    path = _find(name_or_path)
    content = _read(path)
    states = {raw: _state(path, raw, text) for raw, text in _states_of(path, content).items()}
    if not {LockState.LOCKED, LockState.UNLOCKED} <= set(states.values()):
        raise ConnectionFailed(f"Car profile {path}: states must name a value for locked and one for unlocked.")
    message = _message(path, content)
    return CarProfile(
        name=path.stem, description=str(content.get("description", "")), message=message,
        signal=_signal(path, content, message), states=states, cycle_time_s=_cycle_time(path, content),
        sent_on_change=bool(content.get("sent_on_change", False)))


def _find(name_or_path: str) -> pathlib.Path:
    shipped = PROFILE_FOLDER / f"{name_or_path}.yaml"
    if shipped.parent == PROFILE_FOLDER and shipped.is_file():
        return shipped
    path = pathlib.Path(name_or_path)
    if path.is_file():
        return path
    names = ", ".join(sorted(file.stem for file in PROFILE_FOLDER.glob("*.yaml")))
    raise ConnectionFailed(f"There is no car profile {name_or_path}; shipped are: {names}; "
                           "a path to a YAML file works too.")


def _read(path: pathlib.Path) -> dict[str, Any]:
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise ConnectionFailed(f"Car profile {path} cannot be read: {_one_line(error)}.") from None
    if not isinstance(content, dict):
        raise ConnectionFailed(f"Car profile {path} is no table of names and values.")
    for key in content:
        if key not in _REQUIRED + _OPTIONAL:
            raise ConnectionFailed(f"Car profile {path}: unknown entry {key}; allowed are "
                                   f"{', '.join(_REQUIRED + _OPTIONAL)}.")
    for key in _REQUIRED:
        if key not in content:
            raise ConnectionFailed(f"Car profile {path} lacks the entry {key}.")
    return content


def _states_of(path: pathlib.Path, content: dict[str, Any]) -> dict[Any, Any]:
    if not isinstance(content["states"], dict):
        raise ConnectionFailed(f"Car profile {path}: states must be a table from raw value to locked, unlocked or "
                               "unknown.")
    return content["states"]


def _state(path: pathlib.Path, raw: Any, text: Any) -> LockState:
    try:
        if isinstance(raw, int) and not isinstance(raw, bool):
            return LockState(text)
    except ValueError:
        pass
    raise ConnectionFailed(f"Car profile {path}: state {raw!r}: {text!r}; allowed is a whole number with locked, "
                           "unlocked or unknown.")


def _cycle_time(path: pathlib.Path, content: dict[str, Any]) -> float:
    cycle_s = content["cycle_time_s"]
    if isinstance(cycle_s, bool) or not isinstance(cycle_s, (int, float)) \
            or not _SHORTEST_CYCLE_S <= cycle_s <= _LONGEST_CYCLE_S:
        raise ConnectionFailed(f"Car profile {path}: cycle_time_s is {cycle_s}; allowed is {_SHORTEST_CYCLE_S:g} to "
                               f"{_LONGEST_CYCLE_S:g} s.")
    return float(cycle_s)


def _message(path: pathlib.Path, content: dict[str, Any]) -> Any:
    database_path = path.parent / str(content["database"])
    try:
        database = cantools.database.load_file(str(database_path), strict=False)
        return database.get_message_by_name(str(content["message"]))
    except KeyError:
        raise ConnectionFailed(f"CAN database {database_path} has no message {content['message']}.") from None
    except (OSError, UnicodeDecodeError, cantools.database.UnsupportedDatabaseFormatError) as error:
        raise ConnectionFailed(f"CAN database {database_path} cannot be read: {_one_line(error)}.") from None


def _signal(path: pathlib.Path, content: dict[str, Any], message: Any) -> str:
    signal = str(content["signal"])
    if signal not in (known.name for known in message.signals):
        database_path = path.parent / str(content["database"])
        raise ConnectionFailed(f"Message {message.name} of CAN database {database_path} has no signal {signal}.")
    return signal


def _one_line(error: Exception) -> str:
    return " ".join((getattr(error, "strerror", None) or str(error)).split()).rstrip(".")
