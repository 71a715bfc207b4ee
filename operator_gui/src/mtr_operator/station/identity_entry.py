"""Identity of a test as typed by the Operator: parsed, checked by the laboratory, and remembered for the next test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import pathlib
from typing import Any, Mapping, NamedTuple

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.equipment_text import equipment_from_text, equipment_text
from mtr_operator.domain.identity.identity import TEXTS, TITLES, Identity
from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.storage.identity_file import GivenIdentity, load_laboratory
from mtr_operator.storage.photos import check_photos

from .number_text import parse_number, written
from .settings import Settings
from .settings_file import SettingsStore


class Annotation(NamedTuple):
    """Addition to a finished test. notes: all of them, including earlier ones; photos: further ones."""

    notes: str
    photos: tuple[pathlib.Path, ...]

    def check(self, identity: Identity) -> None:
        """Raise InvalidIdentity if a test with this identity cannot accept it."""
        identity_from({"notes": self.notes})
        check_photos(self.photos, len(identity.photos))


# Fields with one text each; photos are files.
FIELDS = tuple(name for name in TITLES if name != "photos")


def typed(identity: Identity, decimal_sign: str = ".") -> dict[str, str]:
    """Return an identity as texts of the fields."""
    texts = {name: getattr(identity, name) for name in TEXTS}
    return {**texts, "key_battery_v": written(identity.key_battery_v, decimal_sign),
            "equipment": equipment_text(identity.equipment)}


def read(texts: Mapping[str, str]) -> tuple[Identity, dict[str, str]]:
    """Return the identity in the fields, and a sentence for each invalid field, which counts as empty."""
    values: dict[str, Any] = {}
    faults: dict[str, str] = {}
    for name, text in texts.items():
        try:
            if text.strip():
                values[name] = _value(name, text)
        except InvalidIdentity as error:
            faults[name] = str(error)
    return Identity(**values), faults


def _value(name: str, text: str) -> Any:
    if name == "key_battery_v":
        return _battery(text)
    if name == "equipment":
        return equipment_from_text(text)
    return getattr(identity_from({name: text}), name)


def _battery(text: str) -> float | None:
    number = parse_number(text)
    if number is None:
        raise InvalidIdentity("key_battery_v is no number; allowed is 0 to 60 V.")
    return identity_from({"key_battery_v": number}).key_battery_v


def proposed(store: SettingsStore, today: datetime.date, former: Identity | None = None) -> Identity:
    """Return the initial content of the fields: from a former test, else the last one typed; empty fields get the
    laboratory's defaults."""
    settings = store.settings
    last = settings.identity.of_another_test(settings.identity_day == today.isoformat())
    if former is not None:
        last = former.of_another_test(is_same_day=False)
    try:
        return last.filled_from(load_laboratory(store.laboratory_path).defaults)
    except InvalidIdentity:  # The start of a test reports it.
        return last


def known_car(settings: Settings, vin: str) -> Identity | None:
    """Return the recorded data of the car with this VIN, and of its key; None for an unknown one."""
    return next((car for car in settings.cars if car.car_vin == vin.strip()), None)


def check_begin(store: SettingsStore, given: GivenIdentity) -> None:
    """Raise InvalidIdentity if no test may start with this; the laboratory's requirements are read again."""
    load_laboratory(store.laboratory_path).check(given.identity, len(given.photos))
    check_photos(given.photos)


def remembering(settings: Settings, identity: Identity, today: datetime.date) -> Settings:
    """Return settings with an identity for the next test, and its car and key for the next use of its VIN."""
    return dataclasses.replace(settings.with_car(identity), identity=dataclasses.replace(identity, notes="", photos=()),
                               identity_day=today.isoformat())
