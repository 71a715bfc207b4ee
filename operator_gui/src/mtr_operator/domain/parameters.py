"""Declaration of a scenario's parameters with unit, range and default, and their validation.

A scenario declares a frozen dataclass:

    @dataclass(frozen=True)
    class MyParameters(ParameterSet):
        minimum_distance_m: float = parameter(0.5, 0.0, 20.0, "m", "Where the approach ends.")

Every violation is an InvalidParameter with a sentence that names the parameter, its value and what is allowed.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import difflib
import math
import re
import reprlib
import sys
from dataclasses import dataclass
from typing import Any, Mapping, TypeVar

from .choice import Choice
from .errors import InvalidParameter

Set = TypeVar("Set", bound="ParameterSet")
# Rounding of a conversion such as 360 degrees to radians and back.
_ROUNDING_DIGITS = 9
_MAX_SHOWN = 60
# Units in which the Operator reads what files hold in m and m/s.
CENTIMETRES = ("cm", 100.0)
KILOMETRES_PER_HOUR = ("km/h", 3.6)
DEGREE = "\N{DEGREE SIGN}"
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+")


@dataclass(frozen=True)
class Declaration:
    """One parameter as it stands in a file: file_key, range and default are in the unit.

    shown: unit in which a person reads it, and how many of it are one of the file's unit. only: choice and word without
    which the number has no effect, None when it always has.
    """

    file_key: str
    default: float | None
    low: float
    high: float
    unit: str
    doc: str
    is_integer: bool
    si_per_unit: float
    shown: tuple[str, float]
    only: tuple[str, str] | None = None

    @property
    def allowed(self) -> str:
        """Range with unit."""
        number = "whole numbers from " if self.is_integer else ""
        return f"{number}{self.low:g} to {with_unit(self.high, self.unit)}"

    def to_si(self, value: Any) -> Any:
        """SI value of what stood in a file; InvalidParameter when it is not a finite number."""
        if value is None and self.default is None:
            return None
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise InvalidParameter(f"Parameter {self.file_key} is {short_text(value)}; {self._hint(value)}")
        if not abs(value) <= sys.float_info.max:
            raise InvalidParameter(f"Parameter {self.file_key} is {short_text(value)}; allowed is {self.allowed}.")
        if self.is_integer:
            if value != int(value):
                raise InvalidParameter(f"Parameter {self.file_key} is {value:g}; allowed are {self.allowed}.")
            return int(value)
        return float(value) * self.si_per_unit

    def text(self, value: float) -> str:
        """A value in the file's unit, with it."""
        return with_unit(value, self.unit)

    def shown_text(self, value: float) -> str:
        """A value in the file's unit as a person reads it."""
        unit, per_unit = self.shown
        return with_unit(value * per_unit, unit)

    def to_unit(self, value: float | None) -> float | None:
        """Inverse of to_si."""
        if value is None or self.is_integer:
            return value
        return round(value / self.si_per_unit, _ROUNDING_DIGITS)

    def check(self, value: float | None) -> None:
        """Raise InvalidParameter unless the SI value lies within the range."""
        if value is not None and not math.isfinite(value):
            raise InvalidParameter(f"Parameter {self.file_key} is {value}; allowed is {self.allowed}.")
        shown = self.to_unit(value)
        if shown is not None and not self.low <= shown <= self.high:
            raise InvalidParameter(f"Parameter {self.file_key} is {with_unit(shown, self.unit)}; "
                                   f"allowed is {self.allowed}.")

    def _hint(self, value: Any) -> str:
        if isinstance(value, str) and len(value) <= _MAX_SHOWN and _DECIMAL_COMMA.fullmatch(value.strip()):
            return f"write a decimal point: {value.strip().replace(',', '.')}."
        return f"allowed is a number, {self.allowed}."


@dataclass(frozen=True)
class Flag:
    """One parameter that is true or false."""

    default: bool
    doc: str

    allowed = "true or false"

    def checked(self, file_key: str, value: Any) -> bool:
        """What stood in a file; InvalidParameter when it is neither."""
        if not isinstance(value, bool):
            raise InvalidParameter(f"Parameter {file_key} is {short_text(value)}; allowed is {self.allowed}.")
        return value


def with_unit(value: float, unit: str) -> str:
    """Number with its unit, if it has one."""
    gap = "" if unit == DEGREE else " "
    return f"{value:g}{gap}{unit}".rstrip()


def short_text(value: Any) -> str:
    """What stood in a file, abbreviated for a sentence."""
    # Abbreviates while it writes: the whole text of a nested value may be longer than the memory.
    try:
        text = reprlib.repr(value)
    # A whole number of more digits than Python writes.
    except ValueError:
        text = f"a value of the kind {type(value).__name__}"
    return text if len(text) <= _MAX_SHOWN else text[:_MAX_SHOWN] + "..."


def parameter(default: Any, low: float, high: float, unit: str, doc: str, *, file_key: str = "",
              si_per_unit: float = 1.0, shown: tuple[str, float] | None = None,
              only: tuple[str, str] | None = None) -> Any:
    """Field of a ParameterSet; default, low and high in the unit of the file, the field's value in SI units.

    file_key: name in files when it differs from the field's (because the unit does). shown: see Declaration; without it
    a person reads the unit of the file. only: see Declaration. A default of None is left to the scenario.
    """
    is_integer = isinstance(default, int) and not isinstance(default, bool)
    value = default if default is None or is_integer else float(default) * si_per_unit
    declared = Declaration(file_key, default, low, high, unit, doc, is_integer, si_per_unit, shown or (unit, 1.0),
                           only)
    return dataclasses.field(default=value, metadata={"declared": declared})


def flag(default: bool, doc: str) -> Any:
    """Field of a ParameterSet that is true or false; it is called the same in files."""
    return dataclasses.field(default=default, metadata={"flag": Flag(default, doc)})


@dataclass(frozen=True)
class ParameterSet:
    """Base of the scenarios' parameters; checked when it is made."""

    self_check: bool = flag(True, "Before the test the robot looks at the Car again from two places; it does not begin "
                                  "when the Car stands elsewhere than it was measured.")

    def __post_init__(self) -> None:
        for name, declared_flag in self.flags().items():
            declared_flag.checked(name, getattr(self, name))
        for name, declared_choice in self.choices().items():
            declared_choice.checked(name, getattr(self, name))
        for name, declared in self.declarations().items():
            declared.check(getattr(self, name))
        self.check()

    def check(self) -> None:
        """Check constraints between parameters; a scenario overrides it."""

    @classmethod
    def declarations(cls) -> dict[str, Declaration]:
        """Declarations of the numbers by field name: a scenario's own, then those of every scenario."""
        declared = [item for item in dataclasses.fields(cls) if "declared" in item.metadata]
        return {item.name: dataclasses.replace(item.metadata["declared"],
                                               file_key=item.metadata["declared"].file_key or item.name)
                for item in sorted(declared, key=lambda item: item.name not in cls.__annotations__)}

    @classmethod
    def flags(cls) -> dict[str, Flag]:
        """Flags by field name, which is also their file key."""
        return {item.name: item.metadata["flag"] for item in dataclasses.fields(cls) if "flag" in item.metadata}

    @classmethod
    def choices(cls) -> dict[str, Choice]:
        """Choices by field name, which is also their file key."""
        return {item.name: item.metadata["choice"] for item in dataclasses.fields(cls) if "choice" in item.metadata}

    @classmethod
    def proposed(cls) -> dict[str, Any]:
        """What from_mapping takes, with what a person begins who chooses anew."""
        return {name: choice.proposed for name, choice in cls.choices().items()}

    def has_effect(self, declared: Declaration) -> bool:
        """False for a number that means nothing with what is chosen."""
        return declared.only is None or bool(getattr(self, declared.only[0]) == declared.only[1])

    @classmethod
    def from_mapping(cls: type[Set], mapping: Mapping[str, Any]) -> Set:
        """Parameters from what stood in a file; what is missing takes its default."""
        fields = {declared.file_key: (name, declared) for name, declared in cls.declarations().items()}
        words: dict[str, Flag | Choice] = {**cls.flags(), **cls.choices()}
        values: dict[str, Any] = {}
        for key, value in mapping.items():
            if key in words:
                values[key] = words[key].checked(key, value)
            elif key in fields:
                name, declared = fields[key]
                values[name] = declared.to_si(value)
            else:
                name = key[:_MAX_SHOWN] if isinstance(key, str) else short_text(key)
                raise InvalidParameter(f"Parameter {name} is unknown; {_alternatives(name, [*fields, *words])}")
        return cls(**values)

    def to_mapping(self) -> dict[str, Any]:
        """What from_mapping takes: every number in the unit of its file key, the choices and the flags."""
        return {**{declared.file_key: declared.to_unit(getattr(self, name))
                   for name, declared in self.declarations().items()},
                **{name: getattr(self, name) for name in (*self.choices(), *self.flags())}}


def _alternatives(key: str, known: list[str]) -> str:
    close = difflib.get_close_matches(key, known, n=1)
    return f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}."
