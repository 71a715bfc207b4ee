"""Parses lines of text as distances: a number in m, or a JSON object with it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import math
import re
from typing import Any, NamedTuple

from mtr_operator.domain.distance_feed import REPORTED
from mtr_operator.domain.limits import Limit
from mtr_operator.domain.results.refused import Refused

# The object of one distance has about fifty characters; an endless line would fill the memory.
MAX_LINE_BYTES = 512
# The fastest known ranging needs some ms per distance; an unlimited stream would fill the memory.
MAX_LINES_PER_S = 200
DISTANCE, CLOCK, AGE = "distance_m", "time_s", "age_s"
_NUMBERS = {DISTANCE: REPORTED, CLOCK: Limit(CLOCK, -1e12, 1e12, "s"), AGE: Limit(AGE, 0.0, 1e6, "s")}
# float() would also accept underscores, "1_5" as 15, and digits of other scripts.
_NUMBER = re.compile(r"\s*[+-]?(([0-9]+\.?[0-9]*|\.[0-9]+)(e[+-]?[0-9]+)?|nan|inf(inity)?)\s*", re.IGNORECASE)
_SHOWN = 60


class Told(NamedTuple):
    """One distance, see Reported."""

    distance_m: float
    feed_s: float | None = None
    age_s: float = 0.0


class LineReader:
    """Parser of a stream of bytes.

    Attributes:
        refused: rejected lines.
    """

    def __init__(self) -> None:
        self.refused = Refused()
        self._rest = b""
        self._is_too_long = False
        self._second, self._lines = -math.inf, 0

    def restart(self) -> None:
        """Start with a new connection: an incomplete line is discarded."""
        self._rest, self._is_too_long = b"", False

    def take(self, data: bytes, now_s: float) -> list[Told]:
        """Add bytes and return the distances. now_s: of any monotonic clock."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        found = [told for line in lines if (told := self._line(line, now_s)) is not None]
        if len(self._rest) > MAX_LINE_BYTES:
            self._rest, self._is_too_long = b"", True
        return found

    def _line(self, line: bytes, now_s: float) -> Told | None:
        was_too_long, self._is_too_long = self._is_too_long, False
        text = line[:MAX_LINE_BYTES].decode("utf-8", errors="replace").strip()
        if not text and not was_too_long:
            return None
        try:
            if was_too_long or len(line) > MAX_LINE_BYTES:
                raise ValueError(f"A line is longer than {MAX_LINE_BYTES} bytes.")
            if self._is_too_fast(now_s):
                raise ValueError(f"More than {MAX_LINES_PER_S} lines came within a second.")
            return _told(text)
        except ValueError as error:
            self.refused = Refused(self.refused.count + 1, str(error))
            return None

    def _is_too_fast(self, now_s: float) -> bool:
        if now_s - self._second >= 1.0:
            self._second, self._lines = now_s, 0
        self._lines += 1
        return self._lines > MAX_LINES_PER_S


def _told(text: str) -> Told:
    """Parse one line; ValueError states a fault."""
    values = _object(text) if text.startswith("{") else {DISTANCE: text}
    if DISTANCE not in values:
        raise ValueError(f"The line {text[:_SHOWN]!r} has no {DISTANCE}.")
    numbers = {name: _number(name, values[name], text) for name in _NUMBERS if values.get(name) is not None}
    if DISTANCE not in numbers:
        raise ValueError(f"The line {text[:_SHOWN]!r} says that no distance is known.")
    return Told(numbers[DISTANCE], numbers.get(CLOCK), numbers.get(AGE, 0.0))


def _object(text: str) -> dict[str, Any]:
    try:
        values = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError(f"The line {text[:_SHOWN]!r} is no JSON object.") from None
    return values if isinstance(values, dict) else {}


def _number(name: str, value: Any, text: str) -> float:
    try:
        if isinstance(value, str) and not _NUMBER.fullmatch(value):
            raise ValueError(value)
        number = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"The line {text[:_SHOWN]!r} is neither a number nor a JSON object with {DISTANCE}.") from None
    wrong = _NUMBERS[name].violation(number)
    if wrong:
        raise ValueError(f"{wrong[:1].upper()}{wrong[1:]}")
    return number
