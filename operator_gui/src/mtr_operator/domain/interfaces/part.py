"""Access to an optional interface of an object."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TypeVar

Kind = TypeVar("Kind")


def part(whole: object, kind: type[Kind]) -> Kind:
    """Return the object as this interface if it derives from it, else an instance with the interface's defaults."""
    return whole if isinstance(whole, kind) else kind()
