"""Signature block of a protocol."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import NamedTuple

from mtr_operator.domain.identity.identity import Identity

MEASURED_BY, CHECKED_BY = "measured by", "checked by"
DATE, SIGNATURE = "date", "signature"


class Signatory(NamedTuple):
    """Person who signs. name: empty if it is written by hand."""

    role: str
    name: str


def signatories(identity: Identity | None) -> tuple[Signatory, Signatory]:
    """Return the person who measured and the person who checks."""
    return Signatory(MEASURED_BY, "" if identity is None else identity.operator), Signatory(CHECKED_BY, "")
