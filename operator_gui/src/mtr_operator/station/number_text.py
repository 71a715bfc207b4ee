"""Numbers as typed and read by the Operator: comma or point, in the unit for people."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import re
from dataclasses import dataclass
from typing import Any

from mtr_operator.domain.parameter_lists import MAX_NUMBERS, ListDeclaration
from mtr_operator.domain.parameters import Declaration

_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d{1,3})?")
# A comma is a decimal sign, so it does not separate numbers.
_BETWEEN_NUMBERS = re.compile(r"\s*;\s*|\s+")
_ROUNDING_DIGITS = 9


class Fault(enum.Enum):
    """Faults of a text."""

    EMPTY = "empty"
    NOT_A_NUMBER = "not a number"
    NOT_WHOLE = "not whole"
    OUT_OF_RANGE = "out of range"


@dataclass(frozen=True)
class Reading:
    """Parsed text: an SI value, a tuple of them for a list, or a fault. An empty text of an optional parameter is None
    without a fault."""

    value: Any
    fault: Fault | None = None


def parse_number(text: str) -> float | None:
    """Return the number with a decimal point or comma; None if it is invalid."""
    text = text.strip()
    return float(text.replace(",", ".")) if _NUMBER.fullmatch(text) else None


def parse_numbers(text: str) -> list[float] | None:
    """Return several numbers, separated by a semicolon or a blank; None if one is invalid."""
    numbers = [parse_number(part) for part in _BETWEEN_NUMBERS.split(text.strip(" ;")) if part]
    known = [number for number in numbers if number is not None]
    return known if len(known) == len(numbers) else None


def read(declared: Declaration, text: str) -> Reading:
    """Parse the field of a parameter, in the unit for people."""
    if not text.strip():
        return Reading(None, Fault.EMPTY if declared.default is not None else None)
    if isinstance(declared, ListDeclaration):
        return _read_list(declared, text)
    number = parse_number(text)
    if number is None:
        return Reading(None, Fault.NOT_A_NUMBER)
    value = round(number / declared.shown[1], _ROUNDING_DIGITS)
    if not declared.low <= value <= declared.high:
        return Reading(None, Fault.OUT_OF_RANGE)
    if declared.is_integer and value != int(value):
        return Reading(None, Fault.NOT_WHOLE)
    return Reading(declared.to_si(int(value) if declared.is_integer else value))


def _read_list(declared: ListDeclaration, text: str) -> Reading:
    readings = [read(declared.one, part) for part in _BETWEEN_NUMBERS.split(text.strip(" ;"))]
    faults = [reading.fault for reading in readings if reading.fault is not None]
    if faults or len(readings) > MAX_NUMBERS:
        return Reading(None, faults[0] if faults else Fault.OUT_OF_RANGE)
    return Reading(tuple(reading.value for reading in readings))


def shown_range(declared: Declaration) -> tuple[float, float]:
    """Return lowest and highest value in the unit for people."""
    _, per_unit = declared.shown
    return round(declared.low * per_unit, _ROUNDING_DIGITS), round(declared.high * per_unit, _ROUNDING_DIGITS)


def shown_number(declared: Declaration, value: float | None) -> float | None:
    """Return an SI value in the unit for people."""
    in_file = declared.to_unit(value)
    return None if in_file is None else round(in_file * declared.shown[1], _ROUNDING_DIGITS)


def shown_value(declared: Declaration, value: Any, decimal_sign: str = ".") -> str:
    """Return an SI value, or list of them, as it is typed."""
    if isinstance(declared, ListDeclaration):
        return "; ".join(shown_value(declared.one, number, decimal_sign) for number in value or ())
    return written(shown_number(declared, value), decimal_sign)


def written(number: float | None, decimal_sign: str = ".") -> str:
    """Return a number without needless digits."""
    return "" if number is None else f"{number:.6g}".replace(".", decimal_sign)
