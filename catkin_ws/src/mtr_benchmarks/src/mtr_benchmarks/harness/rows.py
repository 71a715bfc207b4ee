"""Rows of a benchmark's table: a value, its limit (must), its goal, and whether it meets them."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Any, Dict, Mapping, Optional, Sequence


@dataclass(frozen=True)
class Requirement:
    """Requirement on one figure.

    Attributes:
        name: name of the figure, for a person.
        unit: unit of value, goal and must; (count), (ratio), (share) and (x), a multiple, for pure numbers.
        goal: desired value; None: no goal beyond must.
        must: limit beyond which the benchmark fails; None: the figure is for information.
        at_least: goal and must are lower bounds; else upper bounds.
    """

    name: str
    unit: str
    goal: Optional[float] = None
    must: Optional[float] = None
    at_least: bool = False

    def allows(self, value: Optional[float], limit: Optional[float]) -> bool:
        """Return True if a value is within a limit. An unknown value is within no limit; without a limit, every value
        is."""
        if limit is None:
            return True
        if value is None or not math.isfinite(value):
            return False
        return value >= limit if self.at_least else value <= limit


@dataclass(frozen=True)
class Row:
    """One figure and its requirement.

    Attributes:
        value: measured value; None: unknown.
        is_complete: all parts of the value were measured; an incomplete row does not meet its requirement.
        details: additional numbers of the row in the file.
        remark: additional information for a person.
    """

    requirement: Requirement
    value: Optional[float]
    is_complete: bool = True
    details: Mapping[str, Optional[float]] = field(default_factory=dict)
    remark: str = ""

    @property
    def is_met(self) -> bool:
        """True if the value meets its limit."""
        return self._is_within(self.requirement.must)

    @property
    def is_goal_met(self) -> bool:
        """True if the value meets its limit and its goal."""
        return self.is_met and self._is_within(self.requirement.goal)

    def as_json(self) -> Dict[str, Any]:
        """Return the row in its file format. The key names are a stable interface."""
        wanted, value = self.requirement, self.value
        return {"name": wanted.name, "unit": wanted.unit,
                "value": value if value is None or math.isfinite(value) else None,
                "goal": wanted.goal, "must": wanted.must, "bound": "at least" if wanted.at_least else "at most",
                **self.details, "met": self.is_met, "goal_met": self.is_goal_met}

    def _is_within(self, limit: Optional[float]) -> bool:
        return limit is None or (self.is_complete and self.requirement.allows(self.value, limit))


def all_met(rows: Sequence[Row]) -> bool:
    """Return True if every row meets its limit."""
    return all(row.is_met for row in rows)
