"""Rows of a benchmark's table: a value, what it must be, what is aimed for, and whether it is that."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Any, Dict, Mapping, Optional, Sequence


@dataclass(frozen=True)
class Requirement:
    """What one figure has to be.

    Attributes:
        name: of the figure, for a person.
        unit: of value, goal and must; (count), (ratio), (share) and (x), a multiple, for pure numbers.
        goal: what is aimed for; None: nothing beyond must.
        must: the benchmark fails without it; None: the figure is for information.
        at_least: goal and must are lower bounds; else upper bounds.
    """

    name: str
    unit: str
    goal: Optional[float] = None
    must: Optional[float] = None
    at_least: bool = False

    def allows(self, value: Optional[float], limit: Optional[float]) -> bool:
        """True when a value is within a limit; a value that is not known is within none, and any is without a limit."""
        if limit is None:
            return True
        if value is None or not math.isfinite(value):
            return False
        return value >= limit if self.at_least else value <= limit


@dataclass(frozen=True)
class Row:
    """One figure and its requirement.

    Attributes:
        value: what was measured; None: not known.
        is_complete: everything that belongs to the value was measured; a row that is not complete is not met.
        details: further numbers that belong to the row in the file.
        remark: what a person has to know besides.
    """

    requirement: Requirement
    value: Optional[float]
    is_complete: bool = True
    details: Mapping[str, Optional[float]] = field(default_factory=dict)
    remark: str = ""

    @property
    def is_met(self) -> bool:
        """True when it is what it must be."""
        return self._is_within(self.requirement.must)

    @property
    def is_goal_met(self) -> bool:
        """True when it is what it must be and what is aimed for."""
        return self.is_met and self._is_within(self.requirement.goal)

    def as_json(self) -> Dict[str, Any]:
        """The row in a file; names of the keys are a promise."""
        wanted, value = self.requirement, self.value
        return {"name": wanted.name, "unit": wanted.unit,
                "value": value if value is None or math.isfinite(value) else None,
                "goal": wanted.goal, "must": wanted.must, "bound": "at least" if wanted.at_least else "at most",
                **self.details, "met": self.is_met, "goal_met": self.is_goal_met}

    def _is_within(self, limit: Optional[float]) -> bool:
        return limit is None or (self.is_complete and self.requirement.allows(self.value, limit))


def all_met(rows: Sequence[Row]) -> bool:
    """True when every row is what it must be."""
    return all(row.is_met for row in rows)
