"""The keys that the robot accepts, each with its owner's name, role and day of pairing, as human-readable text."""
# SPDX-License-Identifier: Apache-2.0
import datetime
import enum
from dataclasses import dataclass
from typing import Any, Optional, Tuple

import yaml

from mtr_core.errors import RobotError
from mtr_proto.keys import fingerprint, is_key
from mtr_proto.pairing import plain_name

# Chosen limit: a fleet has a few laptops, and each entry needs about 150 bytes.
MAX_KEYS = 64
MAX_BYTES = 64 * 1024
HEADER = ("# Keys that may use the robot's link; `rosrun mtr_dispatcher pair` adds, `rosrun mtr_dispatcher keys` lists "
          "and revokes.\n# role: a controller moves the robot, a viewer looks only. A change holds at once.\n")


class KeysError(RobotError):
    """The list of keys is damaged, or lacks the requested entry."""


class Role(enum.Enum):
    """Rights of a key's owner."""

    CONTROLLER = "controller"
    VIEWER = "viewer"


@dataclass(frozen=True)
class Entry:
    """One key. date: day of pairing, ISO 8601. key: public, Z85."""

    name: str
    role: Role
    date: str
    key: str


@dataclass(frozen=True)
class AuthorisedKeys:
    """The list in the order of pairing; names and keys are unique."""

    entries: Tuple[Entry, ...] = ()

    def of(self, key: str) -> Optional[Entry]:
        """Return the entry of a key, or None if the key is unknown."""
        return next((entry for entry in self.entries if entry.key == key), None)

    def with_entry(self, entry: Entry) -> "AuthorisedKeys":
        """Return the list with this entry added; it replaces an entry with the same key.

        If another key already has the name, a number is appended to it.

        Raises:
            KeysError: the list is full.
        """
        others = tuple(each for each in self.entries if each.key != entry.key)
        if len(others) >= MAX_KEYS:
            raise KeysError(f"{len(others)} keys are paired; allowed are {MAX_KEYS}. Revoke one first.")
        taken = {each.name for each in others}
        names = [entry.name, *(f"{entry.name} {number}" for number in range(2, MAX_KEYS + 2))]
        name = next(name for name in names if name not in taken)
        return AuthorisedKeys((*others, Entry(name, entry.role, entry.date, entry.key)))

    def without(self, name: str) -> "AuthorisedKeys":
        """Return the list without the key of this owner.

        Raises:
            KeysError: no key has this owner.
        """
        if name not in {entry.name for entry in self.entries}:
            names = ", ".join(entry.name for entry in self.entries) or "none"
            raise KeysError(f"No key of {name} is paired; there are: {names}.")
        return AuthorisedKeys(tuple(entry for entry in self.entries if entry.name != name))

    def to_text(self) -> str:
        """Return the text of the file."""
        listed = [{"name": entry.name, "role": entry.role.value, "date": entry.date, "key": entry.key}
                  for entry in self.entries]
        text: str = yaml.safe_dump({"keys": listed}, sort_keys=False, allow_unicode=True, width=200)
        return HEADER + text

    def lines(self) -> Tuple[str, ...]:
        """Return one line per key for display."""
        width = max((len(entry.name) for entry in self.entries), default=0)
        return tuple(f"{entry.name:{width}}  {entry.role.value:10}  {entry.date}  {fingerprint(entry.key)}"
                     for entry in self.entries)


def keys_in(text: str) -> AuthorisedKeys:
    """Parse the list in a file's text.

    Raises:
        KeysError: the text is not a valid list; the caller then accepts no key rather than a wrong one.
    """
    if len(text) > MAX_BYTES:
        raise KeysError(f"It is larger than {MAX_BYTES // 1024} KiB.")
    try:
        document = yaml.safe_load(text) or {}
        found = AuthorisedKeys()
        for item in document.get("keys") or ():
            found = found.with_entry(_entry(item))
    except (yaml.YAMLError, LookupError, TypeError, ValueError, AttributeError, RecursionError):
        raise KeysError("It is no list of keys with name, role, date and key.") from None
    return found


def _entry(item: Any) -> Entry:
    day = item["date"]
    # YAML parses an unquoted day as a date.
    date = day.isoformat() if isinstance(day, datetime.date) else str(day)
    if not is_key(item["key"]):
        raise ValueError("key")
    return Entry(plain_name(item["name"]), Role(item["role"]), date, item["key"])
