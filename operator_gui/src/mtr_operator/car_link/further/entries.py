"""Entries of a car's profile: each is read with a sentence for whatever may be wrong with it."""
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
# Of a text of a profile, which sentences quote: longer than any name, description or path to a database.
MAX_TEXT = 1000
# The bus of the profile's own database; further ones have names.
FIRST_BUS = ""
# A state of some cars' signal: all but the driver's door are still locked.
DRIVER_ONLY = "unlocked_driver"
STATES = {**{state.value: state for state in LockState}, DRIVER_ONLY: LockState.UNLOCKED}


# Folder in which databases are looked for that do not lie beside their profiles, for every command and the window.
DATABASES_VARIABLE = "MTR_CAR_DATABASES"
# Of the shipped profiles and their databases.
PROFILE_FOLDER = pathlib.Path(__file__).parent.parent / "profiles"


def database_folders(profile_folder: pathlib.Path) -> tuple[pathlib.Path, ...]:
    """Folders in which the databases of a profile in this folder may lie, in the order of the search."""
    elsewhere = os.environ.get(DATABASES_VARIABLE, "")
    return profile_folder, *((pathlib.Path(elsewhere),) if elsewhere else ()), PROFILE_FOLDER


class Entries:
    """content: of the YAML file at path. databases: folder of its databases, None for database_folders()."""

    def __init__(self, path: pathlib.Path, content: Mapping[str, Any], databases: pathlib.Path | None = None):
        self.content = content
        self._path = path
        self._folders = database_folders(path.parent) if databases is None else (databases, path.parent)
        self._databases: dict[str, CarDatabase] = {}

    def wrong(self, text: str) -> ConnectionFailed:
        """What is wrong with the profile."""
        return ConnectionFailed(f"Car profile {self._path}: {text}")

    def states(self, table: Any) -> dict[int, LockState]:
        """Lock state of each raw value; one for locked and one for unlocked at least."""
        states = {raw: STATES[word] for raw, word in self.words("states", table, STATES).items()}
        if not _has_both(states):
            raise self.wrong("states must name a value for locked and one for unlocked.")
        return states

    def states_of(self, signals: Sequence[Any]) -> dict[int, LockState]:
        """The entry states, with the raw values as they are decoded from the signals (cantools')."""
        states = self.decoded_words("states", self.states(self.content["states"]), signals)
        # Of the signals of several doors, some may have fewer values than the others.
        if len(signals) == 1 and not _has_both(states):
            raise self.wrong(f"states names values for locked and unlocked that the signal {signals[0].name} of "
                             f"{signals[0].length} bits cannot carry.")
        return states

    def words(self, key: str, table: Any, allowed: Sequence[str] | Mapping[str, Any]) -> dict[int, str]:
        """Word of each raw value that an entry lists."""
        if not isinstance(table, dict):
            raise self.wrong(f"{key} must be a table from raw value to {_either(allowed)}.")
        for raw, word in table.items():
            if not is_whole(raw) or not isinstance(word, str) or word not in allowed:
                raise self.wrong(f"{key} has {raw!r}: {word!r}; allowed is a whole number with {_either(allowed)}.")
        return dict(table)

    def duration(self, key: str, limits_s: tuple[float, float], default_s: Any = None) -> Any:
        """Time in s of an entry, the default when it is absent."""
        if key not in self.content:
            return default_s
        time_s, (low_s, high_s) = self.content[key], limits_s
        if isinstance(time_s, bool) or not isinstance(time_s, (int, float)) or not low_s <= time_s <= high_s:
            raise self.wrong(f"{key} is {time_s}; allowed is {low_s:g} to {high_s:g} s.")
        return float(time_s)

    def flag(self, key: str) -> bool:
        """An entry that is true or false, false when it is absent."""
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
        """Of a bus that is declared; ConnectionFailed for a name that leads out of the folders of databases: a profile
        may come from somebody else, and its databases are copied into bundles."""
        name = self.content["database"] if bus == FIRST_BUS else self.content["buses"][bus]
        try:
            paths = [below(folder, name) for folder in self._folders]
        except UnsafeName as error:
            raise self.wrong(f"CAN databases must be next to the profile or in the folder set by {DATABASES_VARIABLE}. "
                             f"{error}") from None
        return next((path for path in paths if is_file(path)), paths[0])

    def usable_databases(self) -> tuple[dict[str, pathlib.Path], dict[str, str]]:
        """Databases of all buses, and why others are left out, by their names: only what can be read as a CAN database
        is one, whatever the profile names."""
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
        """Of CAN messages; for one of another kind an empty one, in which no message is found."""
        if bus not in self._databases:
            self._databases[bus] = load_database(self.database_path(bus))
        return self._databases[bus]

    def message(self, name: Any, bus: str = FIRST_BUS) -> Any:
        """A message of a bus' database."""
        return self.database(bus).message(str(name))

    def signal(self, message: Any, name: Any, bus: str = FIRST_BUS) -> str:
        """A signal of a message."""
        return self.database(bus).signal(message, str(name))

    @staticmethod
    def decoded(raw: int, signals: Iterable[Any]) -> frozenset[int]:
        """A raw value that an entry lists, as it is decoded from signals (cantools'); empty when none can carry it."""
        values = (as_decoded(signal, raw) for signal in signals)
        return frozenset(value for value in values if value is not None)

    def decoded_words(self, key: str, words: Mapping[int, Word], signals: Sequence[Any]) -> dict[int, Word]:
        """A table of raw values, as they are decoded from signals."""
        found: dict[int, Word] = {}
        for raw, word in words.items():
            for value in self.decoded(raw, signals):
                if found.setdefault(value, word) != word:
                    raise self.wrong(f"{key} has {raw} and {value}, which are the same bits, with two meanings.")
        return found


def _has_both(states: Mapping[int, LockState]) -> bool:
    return {LockState.LOCKED, LockState.UNLOCKED} <= set(states.values())


def is_file(path: pathlib.Path) -> bool:
    """True for a file that is there; whatever the system cannot even look for is not."""
    try:
        return path.is_file()
    except OSError:
        return False


def has_long_text(value: Any) -> bool:
    """True when a value of a profile has a text, in tables and lists too, that is longer than MAX_TEXT."""
    if isinstance(value, dict):
        return any(has_long_text(each) for pair in value.items() for each in pair)
    if isinstance(value, list):
        return any(has_long_text(each) for each in value)
    return isinstance(value, (str, bytes)) and len(value) > MAX_TEXT


def is_whole(value: Any) -> bool:
    """A number without a fraction, which YAML's yes and no are not."""
    return isinstance(value, int) and not isinstance(value, bool)


def _either(words: Sequence[str] | Mapping[str, Any]) -> str:
    *others, last = words
    return f"{', '.join(others)} or {last}"
