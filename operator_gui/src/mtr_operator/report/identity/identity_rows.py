"""Identity as rows of names and values for a protocol, and as lines of results.csv."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Tuple

from mtr_operator.domain.identity.equipment_text import one_line
from mtr_operator.domain.identity.identity import TEXTS, TITLES, Identity

Row = Tuple[str, str]
# The panel next to the picture shows the fields that identify a test; the others are on a separate page.
_SHORT = ("car_vin", "car_model", "car_software", "key_serial", "key_battery_v", "operator",
          "person_in_charge", "place")
_MAX_SHORT = 34
# Number of check sum characters that a person compares.
_DIGEST = 12


def identity_rows(identity: Identity | None) -> list[Row]:
    """Return all known fields, in the order of a protocol; notes line by line."""
    if identity is None:
        return []
    rows = []
    for name, title in TITLES.items():
        rows += [(title, value) for value in _values(identity, name)]
    return rows


def short_rows(identity: Identity | None) -> list[Row]:
    """Return the fields that identify a test, shortened to the panel next to a picture."""
    if identity is None:
        return []
    rows = [(TITLES[name], value) for name in _SHORT for value in _values(identity, name)]
    return [(name, value if len(value) <= _MAX_SHORT else value[:_MAX_SHORT - 1] + "\N{HORIZONTAL ELLIPSIS}")
            for name, value in rows]


def identity_lines(identity: Identity | None) -> Iterator[str]:
    """Yield lines such as "identity car_vin: WVWZZZ1KZAW000001"; notes are one line."""
    if identity is None:
        return
    for name in TITLES:
        if name == "photos":
            yield from (f"identity photo: {photo.name} (SHA-256 {photo.sha256})" for photo in identity.photos)
        elif name == "notes":
            yield from [f"identity notes: {' '.join(identity.notes.split())}"] if identity.notes else []
        else:
            yield from (f"identity {name}: {value}" for value in _values(identity, name))


def _values(identity: Identity, name: str) -> list[str]:
    if name == "notes":
        return [line for line in identity.notes.splitlines() if line.strip()]
    if name in TEXTS:
        text = getattr(identity, name)
        return [text] if text else []
    if name == "key_battery_v":
        return [] if identity.key_battery_v is None else [f"{identity.key_battery_v:g} V"]
    if name == "equipment":
        return [one_line(each) for each in identity.equipment]
    return [f"{photo.name} (SHA-256 {photo.sha256[:_DIGEST]}\N{HORIZONTAL ELLIPSIS})" for photo in identity.photos]
