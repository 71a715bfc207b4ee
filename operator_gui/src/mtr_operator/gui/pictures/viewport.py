"""Where a place around the Car lies on the screen: scale, middle, zoom. The Car's front is up."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Iterable

from mtr_operator.domain.geometry.pose import Point

MIN_PX_PER_M = 4.0
MAX_PX_PER_M = 800.0


@dataclass(frozen=True)
class Viewport:
    """middle_x, middle_y: place in the Car coordinate system, in m, in the middle of width by height pixels."""

    width: float
    height: float
    px_per_m: float = 50.0
    middle_x: float = 0.0
    middle_y: float = 0.0

    def to_screen(self, point: Point) -> Point:
        """Pixels, to the right and down."""
        return (self.width / 2.0 - (point[1] - self.middle_y) * self.px_per_m,
                self.height / 2.0 - (point[0] - self.middle_x) * self.px_per_m)

    def to_car(self, pixel: Point) -> Point:
        """Inverse of to_screen."""
        return (self.middle_x - (pixel[1] - self.height / 2.0) / self.px_per_m,
                self.middle_y - (pixel[0] - self.width / 2.0) / self.px_per_m)

    def zoomed(self, factor: float, pixel: Point) -> Viewport:
        """Larger by the factor, with the place under the pixel where it was."""
        place = self.to_car(pixel)
        scale = min(max(self.px_per_m * factor, MIN_PX_PER_M), MAX_PX_PER_M)
        return replace(self, px_per_m=scale)._with_place_at(place, pixel)

    def panned(self, right_px: float, down_px: float) -> Viewport:
        """The picture moved by pixels."""
        return replace(self, middle_x=self.middle_x + down_px / self.px_per_m,
                       middle_y=self.middle_y + right_px / self.px_per_m)

    def resized(self, width: float, height: float) -> Viewport:
        """Another size, with the same place in the middle."""
        return replace(self, width=width, height=height)

    def fitted(self, points: Iterable[Point], margin_px: float) -> Viewport:
        """All points, and the Car's centre in the middle."""
        reach_x = reach_y = 1.0
        for x, y in points:
            reach_x, reach_y = max(reach_x, abs(x)), max(reach_y, abs(y))
        scale = min((self.width - 2.0 * margin_px) / (2.0 * reach_y), (self.height - 2.0 * margin_px) / (2.0 * reach_x))
        return replace(self, px_per_m=min(max(scale, MIN_PX_PER_M), MAX_PX_PER_M), middle_x=0.0, middle_y=0.0)

    def _with_place_at(self, place: Point, pixel: Point) -> Viewport:
        return replace(self, middle_x=place[0] + (pixel[1] - self.height / 2.0) / self.px_per_m,
                       middle_y=place[1] + (pixel[0] - self.width / 2.0) / self.px_per_m)
