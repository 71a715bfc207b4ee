"""Reads the entries of a car's profile; each fault is reported as a sentence."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
from typing import Any, Iterable, Mapping, Sequence, TypeVar

from mtr_operator.domain.errors import ConnectionFailed, UnsafeName
from mtr_operator.domain.ports import LockState
from mtr_operator.storage.inside import below

from ..database.car_database import CarDatabase
from ..database.codec import as_decoded
from ..database.load import load_database

Word = TypeVar("Word")
# Maximum length of a profile's text, which sentences quote: longer than any name, description or path to a database.
MAX_TEXT = 1000
# The bus of the profile's own database; further ones have names.
FIRST_BUS = ""
# State value of some cars: all doors but the driver's are locked.
DRIVER_ONLY = "unlocked_driver"
STATES = {**{state.value: state for state in LockState}, DRIVER_ONLY: LockState.UNLOCKED}


# Folder of databases that are not next to their profiles, for every command and the window.
DATABASES_VARIABLE = "MTR_CAR_DATABASES"
# Folder of the shipped profiles and their databases.
PROFILE_FOLDER = pathlib.Path(__file__).parent.parent / "profiles"


def database_folders(profile_folder: pathlib.Path) -> tuple[pathlib.Path, ...]:
    """Return the folders in which databases of a profile in this folder are searched, in this order."""
    elsewhere = os.environ.get(DATABASES_VARIABLE, "")
    return profile_folder, *((pathlib.Path(elsewhere),) if elsewhere else ()), PROFILE_FOLDER


class Entries:
    """Entries of a profile. content: of the YAML file at path. databases: folder of its databases, None for
    database_folders()."""

    def __init__(self, path: pathlib.Path, content: Mapping[str, Any], databases: pathlib.Path | None = None):
        self.content = content
        self._path = path
        self._folders = database_folders(path.parent) if databases is None else (databases, path.parent)
        self._databases: dict[str, CarDatabase] = {}

    def wrong(self, text: str) -> ConnectionFailed:
        """Return the exception that states a fault of the profile."""
        return ConnectionFailed(f"Car profile {self._path}: {text}")

    def states(self, table: Any) -> dict[int, LockState]:
        """Lock state of each raw value; at least one locked and one unlocked."""
        states = {raw: STATES[word] for raw, word in self.words("states", table, STATES).items()}
        if not _has_both(states):
            raise self.wrong("states must name a value for locked and one for unlocked.")
        return states

    def states_of(self, signals: Sequence[Any]) -> dict[int, LockState]:
        """Return the entry states, with the raw values as decoded from the signals (cantools')."""
        states = self.decoded_words("states", self.states(self.content["states"]), signals)
        # With one signal per door, some signals may have fewer values than others.
        if len(signals) == 1 and not _has_both(states):
            raise self.wrong(f"states names values for locked and unlocked that the signal {signals[0].name} of "
                             f"{signals[0].length} bits cannot carry.")
        return states

    def words(self, key: str, table: Any, allowed: Sequence[str] | Mapping[str, Any]) -> dict[int, str]:
        """Return the word of each raw value that an entry lists."""
        if not isinstance(table, dict):
            raise self.wrong(f"{key} must be a table from raw value to {_either(allowed)}.")
        for raw, word in table.items():
            if not is_whole(raw) or not isinstance(word, str) or word not in allowed:
                raise self.wrong(f"{key} has {raw!r}: {word!r}; allowed is a whole number with {_either(allowed)}.")
        return dict(table)

    def duration(self, key: str, limits_s: tuple[float, float], default_s: Any = None) -> Any:
        """Return the time in s of an entry, or the default if it is absent."""
        if key not in self.content:
            return default_s
        time_s, (low_s, high_s) = self.content[key], limits_s
        if isinstance(time_s, bool) or not isinstance(time_s, (int, float)) or not low_s <= time_s <= high_s:
            raise self.wrong(f"{key} is {time_s}; allowed is {low_s:g} to {high_s:g} s.")
        return float(time_s)

    def flag(self, key: str) -> bool:
        """Return a boolean entry, False if absent."""
        return bool(self.content.get(key, False))

    @property
    def buses(self) -> tuple[str, ...]:
        """Names of the further buses, in their order."""
        table = self.content.get("buses", {})
        if not isinstance(table, dict) or not all(
                isinstance(name, str) and name and isinstance(file, str) for name, file in table.items()):
            raise self.wrong("buses must be a table from the name of a further bus to its CAN database.")
        return tuple(table)

    def database_path(self, bus: str = FIRST_BUS) -> pathlib.Path:
        """Return the path of a declared bus' database. ConnectionFailed for a name outside the folders of databases,
        because profiles may come from third parties and their databases are copied into bundles."""
        name = self.content["database"] if bus == FIRST_BUS else self.content["buses"][bus]
        try:
            paths = [below(folder, name) for folder in self._folders]
        except UnsafeName as error:
            raise self.wrong(f"CAN databases must be next to the profile or in the folder set by {DATABASES_VARIABLE}. "
                             f"{error}") from None
        return next((path for path in paths if is_file(path)), paths[0])

    def usable_databases(self) -> tuple[dict[str, pathlib.Path], dict[str, str]]:
        """Return the databases of all buses, and the reasons for omitting others, by their names. Only files that can
        be read as CAN databases are included."""
        files: dict[str, pathlib.Path] = {}
        left_out: dict[str, str] = {}
        for bus in (*((FIRST_BUS,) if "database" in self.content else ()), *self.buses):
            try:
                path = self.database_path(bus)
                if not self.database(bus).messages:
                    raise self.wrong(f"{path.name} holds no CAN messages.")
                files[path.name] = path
            except ConnectionFailed as error:
                left_out[f"CAN database {bus}".rstrip()] = str(error)
        return files, left_out

    def database(self, bus: str = FIRST_BUS) -> CarDatabase:
        """Return a bus' database of CAN messages; for a different kind an empty one, in which no message is found."""
        if bus not in self._databases:
            self._databases[bus] = load_database(self.database_path(bus))
        return self._databases[bus]

    def message(self, name: Any, bus: str = FIRST_BUS) -> Any:
        """Return a message of a bus' database."""
        return self.database(bus).message(str(name))

    def signal(self, message: Any, name: Any, bus: str = FIRST_BUS) -> str:
        """Return the name of a message's signal as in the database."""
        return self.database(bus).signal(message, str(name))

    @staticmethod
    def decoded(raw: int, signals: Iterable[Any]) -> frozenset[int]:
        """Return a listed raw value as decoded from the signals (cantools'); empty if no signal can carry it."""
        values = (as_decoded(signal, raw) for signal in signals)
        return frozenset(value for value in values if value is not None)

    def decoded_words(self, key: str, words: Mapping[int, Word], signals: Sequence[Any]) -> dict[int, Word]:
        """Return a table of raw values as decoded from the signals."""
        found: dict[int, Word] = {}
        for raw, word in words.items():
            for value in self.decoded(raw, signals):
                if found.setdefault(value, word) != word:
                    raise self.wrong(f"{key} has {raw} and {value}, which are the same bits, with two meanings.")
        return found


def _has_both(states: Mapping[int, LockState]) -> bool:
    return {LockState.LOCKED, LockState.UNLOCKED} <= set(states.values())


def is_file(path: pathlib.Path) -> bool:
    """Return True for an existing file; False also if the system cannot check the path."""
    try:
        return path.is_file()
    except OSError:
        return False


def has_long_text(value: Any) -> bool:
    """Return True if a value of a profile, or of its nested tables and lists, has a text longer than MAX_TEXT."""
    if isinstance(value, dict):
        return any(has_long_text(each) for pair in value.items() for each in pair)
    if isinstance(value, list):
        return any(has_long_text(each) for each in value)
    return isinstance(value, (str, bytes)) and len(value) > MAX_TEXT


def is_whole(value: Any) -> bool:
    """Return True for a number without a fraction; YAML's yes and no are not numbers."""
    return isinstance(value, int) and not isinstance(value, bool)


def _either(words: Sequence[str] | Mapping[str, Any]) -> str:
    *others, last = words
    return f"{', '.join(others)} or {last}"
