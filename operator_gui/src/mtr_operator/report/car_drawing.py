"""The Car from above, front upwards."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch, Polygon

from mtr_operator.domain.ports import CarDimensions

_BODY = {"facecolor": "#dfe3e8", "edgecolor": "#39424e", "linewidth": 1.4}
_GLASS = {"facecolor": "#8fa3b8", "edgecolor": "#39424e", "linewidth": 0.7}
_LAMP = {"facecolor": "#f7e7a1", "edgecolor": "#39424e", "linewidth": 0.6}
_TAIL_LAMP = {"facecolor": "#c0392b", "edgecolor": "#39424e", "linewidth": 0.6}
_ROUNDING_PART = 0.16
# Five bold letters are about 3.9 times as wide as their size.
_LARGEST_FONT, _FONT_PART = 7.0, 0.2

# Parts as polygons: (part of the half length towards the front, part of the half width towards the left).
_WINDSCREEN = ((0.38, -0.80), (0.38, 0.80), (0.14, 0.66), (0.14, -0.66))
_REAR_WINDOW = ((-0.74, -0.74), (-0.74, 0.74), (-0.56, 0.64), (-0.56, -0.64))
_SIDE_WINDOW = ((0.26, 0.84), (-0.62, 0.80), (-0.52, 0.70), (0.12, 0.72))
_HEADLAMP = ((0.97, 0.42), (0.94, 0.78), (0.86, 0.86), (0.90, 0.46))
_TAIL = ((-0.985, 0.50), (-0.955, 0.84), (-0.91, 0.90), (-0.94, 0.52))


def draw_car(axes: Axes, car: CarDimensions, points_per_m: float) -> None:
    """Draw the Car; axes have y of the Car coordinate system across (growing to the left) and x upwards."""
    half_length, half_width = car.length / 2.0, car.width / 2.0
    rounding = _ROUNDING_PART * car.width
    axes.add_patch(FancyBboxPatch(
        (-half_width + rounding, -half_length + rounding), car.width - 2 * rounding, car.length - 2 * rounding,
        boxstyle=f"round,pad={rounding},rounding_size={rounding}", zorder=3, **_BODY))
    for part in (_WINDSCREEN, _REAR_WINDOW, _SIDE_WINDOW, _mirrored(_SIDE_WINDOW)):
        axes.add_patch(Polygon(_scaled(part, half_length, half_width), closed=True, zorder=4, **_GLASS))
    for part, look in ((_HEADLAMP, _LAMP), (_TAIL, _TAIL_LAMP)):
        for side in (part, _mirrored(part)):
            axes.add_patch(Polygon(_scaled(side, half_length, half_width), closed=True, zorder=4, **look))
    font_size = min(_LARGEST_FONT, _FONT_PART * car.width * points_per_m)
    axes.text(0.0, 0.66 * half_length, "FRONT", ha="center", va="center", fontsize=font_size, color="#39424e", zorder=5,
              fontweight="bold")


def _scaled(part: Sequence[tuple[float, float]], half_length: float, half_width: float) -> list[tuple[float, float]]:
    return [(across * half_width, ahead * half_length) for ahead, across in part]


def _mirrored(part: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(ahead, -across) for ahead, across in part]
