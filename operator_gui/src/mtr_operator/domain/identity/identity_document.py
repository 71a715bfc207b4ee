"""An identity from the plain values of a file; each refusal is one sentence that names the place in it.

    car_vin: WVWZZZ1KZAW000001      # texts of at most 120 characters in one line; all keys may be missing
    car_model: Golf
    car_software: "0412"
    key_serial: "0042"
    key_type: remote
    key_battery_v: 3.02             # 0 to 60 V
    operator: J. Novak
    person_in_charge: M. Svoboda    # required for a test on a real robot
    place: Hall 2
    weather: dry, 8 degrees
    notes: |                        # at most 4000 characters, lines as they are
      Doors shut, one other key in the office.
    equipment:                      # at most 40
      - {name: multimeter, serial: "77", calibrated: 2026-03-01, valid_until: 2027-03-01}
    photos: []                      # in the record: name and sha256 of each
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import difflib
import re
from typing import Any, Mapping

from ..errors import InvalidIdentity
from .file_name import name_problem, shown
from .identity import (
    BATTERY_V,
    MAX_EQUIPMENT,
    MAX_NOTES,
    MAX_PHOTOS,
    MAX_TEXT,
    TEXTS,
    TITLES,
    Equipment,
    Identity,
    Photo,
)

_EQUIPMENT_KEYS = ("name", "serial", "calibrated", "valid_until")
_SHA256 = re.compile("[0-9a-f]{64}")
_MAX_SHOWN = 40


def identity_from(document: Any) -> Identity:
    """Return the identity in a document; InvalidIdentity states fault and position."""
    check_table(document, tuple(TITLES), "")
    values: dict[str, Any] = {name: _notes(document[name]) if name == "notes" else text_of(document[name], name)
                              for name in TEXTS if document.get(name) is not None}
    battery = document.get("key_battery_v")
    if battery is not None:
        violation = BATTERY_V.violation(battery)
        if violation:
            raise InvalidIdentity(violation)
        values["key_battery_v"] = float(battery)
    equipment = _list(document, "equipment", MAX_EQUIPMENT)
    values["equipment"] = tuple(_equipment(number, entry) for number, entry in enumerate(equipment, start=1))
    values["photos"] = tuple(map(_photo, _list(document, "photos", MAX_PHOTOS)))
    return Identity(**values)


def check_table(table: Any, known: tuple[str, ...], place: str) -> None:
    """Raise InvalidIdentity unless it is a table with only known keys."""
    if not isinstance(table, Mapping):
        raise InvalidIdentity(f"{place}it has to consist of lines of the form 'name: value'.")
    unknown = next((str(key)[:_MAX_SHOWN] for key in table if key not in known), None)
    if unknown is not None:
        close = difflib.get_close_matches(unknown, known, 1)
        raise InvalidIdentity(f"{place}{unknown!r} is unknown; known are {', '.join(known)}."
                              if not close else f"{place}{unknown!r} is unknown; did you mean {close[0]!r}?")


def text_of(value: Any, place: str) -> str:
    """Return a text of one line; InvalidIdentity names the position of an invalid one."""
    if isinstance(value, (int, float)):
        raise InvalidIdentity(f"{place} is a number; write it in quotes, so that its zeros are kept.")
    if not isinstance(value, str) or len(value) > MAX_TEXT or not value.isprintable():
        raise InvalidIdentity(f"{place} has to be a text of at most {MAX_TEXT} characters in one line.")
    return value.strip()


def _notes(value: Any) -> str:
    letters = value.replace("\n", "").replace("\t", "") if isinstance(value, str) else "\n"
    if len(letters) > MAX_NOTES or not letters.isprintable():
        raise InvalidIdentity(f"notes has to be a text of at most {MAX_NOTES} characters.")
    return str(value).strip()


def _list(document: Mapping[str, Any], name: str, most: int) -> list[Any]:
    entries = document.get(name)
    if entries is None:
        return []
    if not isinstance(entries, list) or len(entries) > most:
        raise InvalidIdentity(f"{name} has to be a list of at most {most} entries.")
    return entries


def _equipment(number: int, entry: Any) -> Equipment:
    place = f"equipment {number}: "
    check_table(entry, _EQUIPMENT_KEYS, place)
    name = text_of(entry.get("name", ""), f"{place}name")
    if not name:
        raise InvalidIdentity(f"{place}name is missing.")
    calibrated, valid_until = (_day(entry.get(key), f"{place}{key}") for key in ("calibrated", "valid_until"))
    if calibrated is not None and valid_until is not None and valid_until < calibrated:
        raise InvalidIdentity(f"{place}valid_until, {valid_until.isoformat()}, is before calibrated, "
                              f"{calibrated.isoformat()}.")
    return Equipment(name, text_of(entry.get("serial") or "", f"{place}serial"), calibrated, valid_until)


def _day(value: Any, place: str) -> datetime.date | None:
    """Return a date: YAML parses it, JSON contains it as a text."""
    if value is None or (isinstance(value, datetime.date) and not isinstance(value, datetime.datetime)):
        return value
    try:
        return datetime.date.fromisoformat(value)
    except (TypeError, ValueError):
        raise InvalidIdentity(f"{place} has to be a day such as 2026-03-01.") from None


def _photo(entry: Any) -> Photo:
    name, digest = (entry.get(key) if isinstance(entry, Mapping) else None for key in ("name", "sha256"))
    if not isinstance(name, str) or not isinstance(digest, str) or not _SHA256.fullmatch(digest):
        raise InvalidIdentity("photos has to be a list of files with name and sha256.")
    problem = name_problem(name)
    if problem:
        raise InvalidIdentity(f"The file name {shown(name)} under photos is refused. {problem}.")
    return Photo(text_of(name, "photos"), digest)
