"""Equipment as a person types it: one instrument a line, its parts between semicolons.

    multimeter; 77; 2026-03-01; 2027-03-01

Name, serial number, day of calibration, last day on which that counts; all but the name may be missing.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ..errors import InvalidIdentity
from .identity import Equipment
from .identity_document import identity_from

_KEYS = ("name", "serial", "calibrated", "valid_until")


def equipment_from_text(text: str) -> tuple[Equipment, ...]:
    """Return the equipment in a text; InvalidIdentity states fault and position."""
    lines = [[part.strip() for part in line.split(";")] for line in text.splitlines() if line.strip()]
    for number, parts in enumerate(lines, start=1):
        if len(parts) > len(_KEYS):
            raise InvalidIdentity(f"equipment {number}: it has {len(parts)} parts between semicolons; allowed are "
                                  "name; serial number; calibrated; valid until.")
    entries = [{key: part for key, part in zip(_KEYS, parts) if part} for parts in lines]
    return identity_from({"equipment": entries}).equipment


def equipment_text(equipment: Sequence[Equipment]) -> str:
    """Return the text of equipment."""
    return "\n".join(one_line(each) for each in equipment)


def one_line(equipment: Equipment) -> str:
    """Return the line of one instrument."""
    days = ["" if day is None else day.isoformat() for day in (equipment.calibrated, equipment.valid_until)]
    parts = [equipment.name, equipment.serial, *days]
    while not parts[-1]:
        parts.pop()
    return "; ".join(parts)
