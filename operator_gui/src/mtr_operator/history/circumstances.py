"""Differences between tests other than their distances: car, key, parameters, software."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import NamedTuple, Sequence

from mtr_operator.domain.identity.equipment_text import equipment_text
from mtr_operator.domain.identity.identity import NOBODY, TITLES
from mtr_operator.domain.results.session_record import ROBOT_SOFTWARE

from .line_pairs import Side

_SESSION = ("car profile", "robot", "software", ROBOT_SOFTWARE)
_IDENTITY = tuple(name for name in TITLES if name not in ("notes", "photos"))
# If a set has more values of one item, only their number is shown.
_MAX_VALUES = 4


class Circumstance(NamedTuple):
    """A difference. is_parameter: name is a key of parameter files."""

    name: str
    first: str
    second: str
    is_parameter: bool = False


def circumstances_of_sets(first: Sequence[Side], second: Sequence[Side]) -> list[Circumstance]:
    """Return all items in which any two tests of two sets differ, with the values of each set."""
    told = [[_told(side) for side in sides] for sides in (first, second)]
    names = dict.fromkeys(name for each in told for test in each for name in test)
    parameters = {name for side in (*first, *second) for name in side.parameters.to_mapping()}
    rows = []
    for name in names:
        mine, its = (list(dict.fromkeys(test.get(name, "") for test in each)) for each in told)
        if len({*mine, *its}) > 1:
            rows.append(Circumstance(name, _joined(mine), _joined(its), name in parameters))
    return rows


def differing_names(sides: Sequence[Side]) -> tuple[str, ...]:
    """Return the names of all items in which any of the tests differ."""
    return tuple(row.name for row in circumstances_of_sets(sides, ()))


def _told(side: Side) -> dict[str, str]:
    """Return all recorded circumstances of a test, by name."""
    return {**{TITLES[name]: _text(side, name) for name in _IDENTITY}, "Car measured": _size(side),
            **{name: side.progress.session.get(name, "") for name in _SESSION},
            **{name: _shown(value) for name, value in side.parameters.to_mapping().items()}}


def _joined(texts: Sequence[str]) -> str:
    if len(texts) > _MAX_VALUES:
        return f"{len(texts)} values"
    return ", ".join(text or "nothing" for text in texts) if len(texts) > 1 else "".join(texts)


def _size(side: Side) -> str:
    car = side.progress.measured_car
    return f"{car.length:.2f} m \N{MULTIPLICATION SIGN} {car.width:.2f} m"


def _text(side: Side, name: str) -> str:
    value = getattr(side.progress.identity or NOBODY, name)
    if name == "equipment":
        return equipment_text(value).replace("\n", ", ")
    return f"{value:g} V" if isinstance(value, float) else value or ""


def _shown(value: object) -> str:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else str(value)
