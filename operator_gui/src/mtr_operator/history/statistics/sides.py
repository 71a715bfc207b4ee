"""Assignment of lines to sides of the Car, by the edge of its outline that they leave; corner lines have no side."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Sequence

from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.robot_status import CarDimensions

_SIDES = {"front": (1, 0), "right": (0, -1), "rear": (-1, 0), "left": (0, 1)}
# A mean requires several lines.
_MIN_LINES = 2
# Tolerance for a computed corner, in m.
_CORNER_M = 1e-6


class SideLines(NamedTuple):
    """Attributes: name: for a person. numbers: of the lines, in their order. is_one_side: False for all lines
    together."""

    name: str
    numbers: tuple[int, ...]
    is_one_side: bool = True


def sides_of(lines: Sequence[Any], car: CarDimensions) -> Iterator[SideLines]:
    """Yield sides with several lines, and all lines together."""
    found: dict[str, list[int]] = {name: [] for name in _SIDES}
    for line in lines:
        side = _side(line.ray, car)
        if side:
            found[side].append(line.number)
    for name, numbers in found.items():
        if len(numbers) >= _MIN_LINES:
            yield SideLines(f"{name} side", tuple(numbers))
    if len(lines) >= _MIN_LINES:
        yield SideLines("all lines", tuple(line.number for line in lines), is_one_side=False)


def _side(ray: Ray, car: CarDimensions) -> str:
    """Return the side through which the ray leaves the Car's rectangle; empty for a corner."""
    ways = {}
    for name, (x, y) in _SIDES.items():
        towards = x * ray.direction_x + y * ray.direction_y
        if towards > 0.0:
            half_m = (car.length if x else car.width) / 2.0
            ways[name] = (half_m - x * ray.origin_x - y * ray.origin_y) / towards
    nearest = sorted(ways.items(), key=lambda way: way[1])
    if len(nearest) > 1 and nearest[1][1] - nearest[0][1] < _CORNER_M:
        return ""
    return nearest[0][0]
