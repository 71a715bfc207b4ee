"""Parameters that are a list of numbers, [0.4, 0.1] in a file: the values of several goes, in turn."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

from .errors import InvalidParameter
from .parameters import Declaration, short_text

# So many goes of one line are more than any test needs.
MAX_NUMBERS = 8


@dataclass(frozen=True)
class ListDeclaration(Declaration):
    """One parameter that is a list; range and unit are those of each number in it. None is left to the scenario."""

    @property
    def allowed(self) -> str:
        """Range with unit, and how many."""
        return f"{self.one.allowed}, up to {MAX_NUMBERS} of them"

    def to_si(self, value: Any) -> Any:
        """See Declaration; a tuple."""
        if value is None:
            return None
        if not isinstance(value, (list, tuple)) or not 0 < len(value) <= MAX_NUMBERS:
            raise InvalidParameter(f"Parameter {self.file_key} is {short_text(value)}; allowed is a list of numbers, "
                                   f"{self.allowed}.")
        return tuple(self.one.to_si(number) for number in value)

    def to_unit(self, value: Any) -> Any:
        """Inverse of to_si; a list, as files have it."""
        return None if value is None else [self.one.to_unit(number) for number in value]

    def check(self, value: Any) -> None:
        """See Declaration."""
        for number in value or ():
            self.one.check(number)

    def text(self, value: Any) -> str:
        """See Declaration."""
        return ", ".join(self.one.text(number) for number in value)

    def shown_text(self, value: Any) -> str:
        """See Declaration."""
        return "; ".join(self.one.shown_text(number) for number in value)

    @property
    def one(self) -> Declaration:
        """Declaration of one number of the list, which may not be missing."""
        values = {item.name: getattr(self, item.name) for item in dataclasses.fields(Declaration)}
        return Declaration(**{**values, "default": self.low})


def parameter_list(low: float, high: float, unit: str, doc: str, *, shown: tuple[str, float] | None = None) -> Any:
    """Field of a ParameterSet that is a tuple of SI numbers, or None by default; see parameters.parameter."""
    declared = ListDeclaration("", None, low, high, unit, doc, False, 1.0, shown or (unit, 1.0))
    return dataclasses.field(default=None, metadata={"declared": declared})
