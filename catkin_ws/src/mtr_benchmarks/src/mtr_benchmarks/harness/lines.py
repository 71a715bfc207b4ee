"""Formats rows of a benchmark's table as lines for a person."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional

from .rows import Row

NAME_WIDTH, VALUE_WIDTH, UNIT_WIDTH = 55, 8, 5


class Shown(NamedTuple):
    """Display format of a unit: scale factor, displayed unit and number of decimals."""

    scale: float
    unit: str
    decimals: int


UNITS = {"m": Shown(100.0, "cm", 2), "(share)": Shown(100.0, "%", 1), "(ratio)": Shown(1.0, "", 3),
         "(count)": Shown(1.0, "", 0), "(x)": Shown(1.0, "x", 1)}


def line(row: Row) -> str:
    """Return name, value, limits and verdict; lengths in cm."""
    wanted = row.requirement
    shown = UNITS.get(wanted.unit, Shown(1.0, wanted.unit, 2))
    value = f"{wanted.name:<{NAME_WIDTH}} {_number(row.value, shown):>{VALUE_WIDTH}} {shown.unit:<{UNIT_WIDTH}}"
    sign = ">=" if wanted.at_least else "<="
    limits = ", ".join(f"{name} {sign} {_number(limit, shown)}" for name, limit in
                       (("must", wanted.must), ("goal", wanted.goal)) if limit is not None)
    said = [f"{limits}: {_verdict(row)}"] if limits else []
    return " ".join([value, ", ".join([*said, *([row.remark] if row.remark else [])])]).rstrip()


def _verdict(row: Row) -> str:
    if not row.is_met:
        return "NOT MET"
    if row.requirement.goal is None or row.is_goal_met:
        return "met" if row.requirement.goal is None else "goal met"
    return "goal not met" if row.requirement.must is None else "met"


def _number(value: Optional[float], shown: Shown) -> str:
    if value is None or not math.isfinite(value):
        return "unknown"
    return f"{shown.scale * value:.{shown.decimals}f}"
