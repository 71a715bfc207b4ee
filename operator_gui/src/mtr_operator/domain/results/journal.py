"""What a test finds out, entry by entry, in the order in which it was found; the port to where it is kept."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Mapping

from .document import plain
from .line_result import LineStatus

# Kinds of entries. The first one holds the progress that a journal begins with.
BEGUN, SESSION, CAR, CHECK = "begun", "session", "car", "check"
LINE_BEGUN, LINE_RESUMED, POINT, SUPERSEDED, LINE = "line_begun", "line_resumed", "point", "superseded", "line"
REVISED, FURTHER = "revised", "further"
# The Operator has left a line; before the result that says so.
SKIPPED = "skipped"
EVENT, PRESS, DECISION = "event", "press", "decision"
# What was said of car, key and operator after the test had begun.
IDENTITY = "identity"


class Journal:
    """Keeps nothing: for requests that measure nothing, and for tests. Those in storage write each entry to disk."""

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        """Keep an entry of plain values. It is safe when `wait` says so; OutputError when it cannot be kept, from here
        or from `check`."""

    def wait(self, patience_s: float = math.inf) -> bool:
        """Wait for so long at most, s of wall time; True when nothing is left to be written. Never raises."""
        return True

    def check(self) -> None:
        """Raise what kept an entry from being safe, once."""


@dataclass(frozen=True)
class KeptPoint:
    """A measurement of a line that has not come to its end, as plain values.

    Attributes:
        status: what became of it. distance: fields of the Distance, None where nothing was measured.
        frame: fields of the KnownFrame in which it was measured, None when that was not known.
    """

    status: LineStatus
    distance: Mapping[str, Any] | None
    frame: Mapping[str, Any] | None


def plain_fields(record: Any) -> Any:
    """Fields of a dataclass as values of a file: NaN is None there, an enumeration its word."""
    if dataclasses.is_dataclass(record) and not isinstance(record, type):
        return {item.name: plain_fields(getattr(record, item.name)) for item in dataclasses.fields(record)}
    if isinstance(record, (list, tuple)):
        return [plain_fields(value) for value in record]
    value = plain(record)
    return None if isinstance(value, float) and not math.isfinite(value) else value
