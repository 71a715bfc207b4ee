"""Identity of a test for its record: car, key, operator, place, weather, notes, photos and equipment."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
from dataclasses import dataclass
from typing import Any

from ..limits import Limit

MAX_TEXT = 120
MAX_NOTES = 4000
MAX_EQUIPMENT = 40
MAX_PHOTOS = 20
# Range from a button cell to the supply of a lorry.
BATTERY_V = Limit("key_battery_v", 0.0, 60.0, "V")


@dataclass(frozen=True)
class Equipment:
    """One instrument. calibrated: date of its calibration; valid_until: last valid date, None for unlimited."""

    name: str
    serial: str = ""
    calibrated: datetime.date | None = None
    valid_until: datetime.date | None = None

    def warning(self, today: datetime.date) -> str:
        """Return a sentence if its calibration has expired, else empty."""
        if self.valid_until is None or today <= self.valid_until:
            return ""
        return (f"The calibration of {self.name} was valid until {self.valid_until.isoformat()}. Calibrate it again, "
                "or take another one.")


@dataclass(frozen=True)
class Photo:
    """Picture stored next to the record: file name, and check sum for the detection of changes."""

    name: str
    sha256: str


@dataclass(frozen=True)
class Identity:
    """Identity; empty values and None are unknown. key_battery_v: voltage of the key's battery before the test.
    person_in_charge: releases site and test; the test of a real robot requires a name."""

    car_vin: str = ""
    car_model: str = ""
    car_software: str = ""
    key_serial: str = ""
    key_type: str = ""
    key_battery_v: float | None = None
    operator: str = ""
    place: str = ""
    weather: str = ""
    notes: str = ""
    equipment: tuple[Equipment, ...] = ()
    photos: tuple[Photo, ...] = ()
    person_in_charge: str = ""

    @property
    def is_empty(self) -> bool:
        """True if nothing is known."""
        return self == NOBODY

    def to_document(self) -> dict[str, Any]:
        """Return the known values as plain values for a file."""
        document = {name: getattr(self, name) for name in TEXTS if getattr(self, name)}
        if self.key_battery_v is not None:
            document["key_battery_v"] = self.key_battery_v
        if self.equipment:
            document["equipment"] = [_plain(each) for each in self.equipment]
        if self.photos:
            document["photos"] = [dataclasses.asdict(photo) for photo in self.photos]
        return document

    def of_another_test(self, is_same_day: bool) -> Identity:
        """Return the part that the next test probably shares: without notes and photos, and on another day without
        weather and battery."""
        kept = dataclasses.replace(self, notes="", photos=())
        return kept if is_same_day else dataclasses.replace(kept, **{name: getattr(NOBODY, name) for name in OF_A_DAY})

    def of_its_car(self) -> Identity:
        """Return only the data of the car and its key."""
        return Identity(**{name: getattr(self, name) for name in OF_A_CAR})

    def filled_from(self, other: Identity) -> Identity:
        """Return this identity, with unknown values from another one."""
        unknown = {field.name: getattr(other, field.name) for field in dataclasses.fields(self)
                   if getattr(self, field.name) == getattr(NOBODY, field.name)}
        return dataclasses.replace(self, **unknown)

    def warnings(self, today: datetime.date) -> list[str]:
        """Return sentences on equipment with expired calibration."""
        return [text for each in self.equipment if (text := each.warning(today))]


NOBODY = Identity()
# Keys of files in the order of a protocol, and their names for people.
TITLES = {
    "car_vin": "Car's VIN", "car_model": "Car's model", "car_software": "Car's software",
    "key_serial": "Key's serial number", "key_type": "Key's type", "key_battery_v": "Key's battery",
    "operator": "Operator", "person_in_charge": "Person in charge", "place": "Place", "weather": "Weather",
    "notes": "Notes", "equipment": "Equipment", "photos": "Photos"}
TEXTS = tuple(name for name in TITLES if isinstance(getattr(NOBODY, name), str))
# Data that is restored with the car's VIN.
OF_A_CAR = ("car_vin", "car_model", "car_software", "key_serial", "key_type")
# Data that is outdated on another day.
OF_A_DAY = ("key_battery_v", "weather")


def _plain(equipment: Equipment) -> dict[str, str]:
    values = dataclasses.asdict(equipment)
    return {name: value.isoformat() if isinstance(value, datetime.date) else value
            for name, value in values.items() if value}
