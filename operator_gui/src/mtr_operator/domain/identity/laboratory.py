"""A laboratory's requirements on the identity of each test, and its defaults.

    required: [car_vin, key_serial, operator, equipment]    # keys of an identity; default: none
    defaults:                                               # an identity, for fields that are not entered
      place: Hall 2
      equipment:
        - {name: multimeter, serial: "77", calibrated: 2026-03-01, valid_until: 2027-03-01}
    unattended_stop: ""       # rated stop with which mtr-operator run needs no person at a real robot; default: none
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

from ..errors import InvalidIdentity
from .identity import NOBODY, TITLES, Identity
from .identity_document import check_table, identity_from, text_of


@dataclass(frozen=True)
class Laboratory:
    """Requirements of a laboratory. required: keys of Identity without which no test starts. defaults: values that
    apply unless others are entered.

    unattended_stop: rated stop of a real robot that may measure without a person; empty if none may.
    """

    required: tuple[str, ...] = ()
    defaults: Identity = NOBODY
    unattended_stop: str = ""

    def missing(self, identity: Identity, photo_count: int | None = None) -> list[str]:
        """Return the required but empty keys. photo_count: of photos to be stored; None counts the identity's.

        Required equipment needs its date of calibration.
        """
        missing = [name for name in self.required if getattr(identity, name) == getattr(NOBODY, name)]
        if photo_count and "photos" in missing:
            missing.remove("photos")
        if "equipment" in self.required and any(each.calibrated is None for each in identity.equipment):
            missing.append("equipment")
        return missing

    def check(self, identity: Identity, photo_count: int) -> None:
        """Raise InvalidIdentity if a required value is missing."""
        missing = self.missing(identity, photo_count)
        if missing:
            raise InvalidIdentity(missing_sentence(missing))


def missing_sentence(missing: Sequence[str]) -> str:
    """Return why a test does not start."""
    names = ", ".join(f"{TITLES[name]} ({name})" for name in missing)
    day = " with the day of its calibration" if "equipment" in missing else ""
    return f"The test does not start: the laboratory requires {names}{day}."


def laboratory_from(document: Any) -> Laboratory:
    """Return a laboratory's requirements in a document, None for an empty one; InvalidIdentity states fault and
    position."""
    if document is None:
        return Laboratory()
    check_table(document, ("required", "defaults", "unattended_stop"), "")
    required = document.get("required") or []
    if not isinstance(required, list) or not all(isinstance(name, str) for name in required):
        raise InvalidIdentity("required has to be a list of keys, such as [car_vin, operator].")
    check_table(dict.fromkeys(required), tuple(TITLES), "required: ")
    defaults = document.get("defaults")
    return Laboratory(tuple(dict.fromkeys(required)), NOBODY if defaults is None else identity_from(defaults),
                      text_of(document.get("unattended_stop") or "", "unattended_stop"))
