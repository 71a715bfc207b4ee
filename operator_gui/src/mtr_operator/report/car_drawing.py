"""The Car from above, front upwards."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch, Polygon

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.robot_status import CarDimensions

from .car_shape import (
    HEADLAMP,
    REAR_WINDOW,
    ROUNDING_PART,
    SIDE_WINDOW,
    TAIL,
    WINDSCREEN,
    mirrored,
    scaled,
)

_BODY = {"facecolor": "#dfe3e8", "edgecolor": "#39424e", "linewidth": 1.4}
_GLASS = {"facecolor": "#8fa3b8", "edgecolor": "#39424e", "linewidth": 0.7}
_LAMP = {"facecolor": "#f7e7a1", "edgecolor": "#39424e", "linewidth": 0.6}
_TAIL_LAMP = {"facecolor": "#c0392b", "edgecolor": "#39424e", "linewidth": 0.6}
# Five bold letters are about 3.9 times as wide as their size.
_MAX_FONT, _FONT_PART = 7.0, 0.2


def draw_car(axes: Axes, car: CarDimensions, points_per_m: float) -> None:
    """Draw the Car; axes have y of the Car coordinate system across (growing to the left) and x upwards."""
    half_length, half_width = car.length / 2.0, car.width / 2.0
    rounding = ROUNDING_PART * car.width
    axes.add_patch(FancyBboxPatch(
        (-half_width + rounding, -half_length + rounding), car.width - 2 * rounding, car.length - 2 * rounding,
        boxstyle=f"round,pad={rounding},rounding_size={rounding}", zorder=3, **_BODY))
    for part in (WINDSCREEN, REAR_WINDOW, SIDE_WINDOW, mirrored(SIDE_WINDOW)):
        axes.add_patch(Polygon(_across_ahead(part, half_length, half_width), closed=True, zorder=4, **_GLASS))
    for part, style in ((HEADLAMP, _LAMP), (TAIL, _TAIL_LAMP)):
        for side in (part, mirrored(part)):
            axes.add_patch(Polygon(_across_ahead(side, half_length, half_width), closed=True, zorder=4, **style))
    font_size = min(_MAX_FONT, _FONT_PART * car.width * points_per_m)
    axes.text(0.0, 0.66 * half_length, "FRONT", ha="center", va="center", fontsize=font_size, color="#39424e", zorder=5,
              fontweight="bold")


def _across_ahead(part: Sequence[Point], half_length: float, half_width: float) -> list[Point]:
    return [(across, ahead) for ahead, across in scaled(part, half_length, half_width)]
