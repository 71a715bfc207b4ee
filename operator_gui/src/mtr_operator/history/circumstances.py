"""In what two tests differ beside their distances: whose car and key, which parameters, which software."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import NamedTuple

from mtr_operator.domain.identity.equipment_text import equipment_text
from mtr_operator.domain.identity.identity import NOBODY, TITLES
from mtr_operator.domain.results.session_record import ROBOT_SOFTWARE

from .line_pairs import Side

_SESSION = ("car profile", "robot", "software", ROBOT_SOFTWARE)
_IDENTITY = tuple(name for name in TITLES if name not in ("notes", "photos"))


class Circumstance(NamedTuple):
    """Something that is not the same. is_parameter: name is a key of parameter files."""

    name: str
    first: str
    second: str
    is_parameter: bool = False


def circumstances(first: Side, second: Side) -> list[Circumstance]:
    """Everything that differs; what neither test says does not."""
    rows = [Circumstance(TITLES[name], _text(first, name), _text(second, name)) for name in _IDENTITY]
    rows.append(Circumstance("Car measured", _size(first), _size(second)))
    rows += [Circumstance(name, first.progress.session.get(name, ""), second.progress.session.get(name, ""))
             for name in _SESSION]
    mine, its = first.parameters.to_mapping(), second.parameters.to_mapping()
    rows += [Circumstance(name, _shown(mine.get(name)), _shown(its.get(name)), True) for name in {**mine, **its}]
    return [row for row in rows if row.first != row.second]


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
