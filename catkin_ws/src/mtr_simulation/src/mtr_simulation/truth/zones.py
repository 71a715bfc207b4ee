"""True coverage of a zone, on the places at which the application may press there."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Iterator, NamedTuple, Tuple

import numpy as np

from mtr_core.errors import check_range

from ..car.honest.radio.key_antenna import Attitude
from ..car.reaction.model import ReactionModel
from .distance import ZONE_SIDES, CarSize, from_outline
from .results import MeasuredEvent, parameter

_COVERED = 0.5


class ZoneGrid(NamedTuple):
    """Parameters of a zone map: places on radials from the Car's outline outwards, in m and degrees."""

    nearest_m: float
    farthest_m: float
    spacing_m: float
    angle_deg: float
    clearance_m: float

    @classmethod
    def of_results(cls, path: pathlib.Path) -> "ZoneGrid":
        """Return the parameters from the metadata; missing ones have the scenario's defaults."""
        return cls(parameter(path, "minimum_distance_m", 0.5), parameter(path, "maximum_distance_m", 6.0),
                   check_range("spacing_m", parameter(path, "spacing_m", 0.5), 0.05, 10.0, "m"),
                   check_range("angle_between_radials_deg", parameter(path, "angle_between_radials_deg", 15.0), 1.0,
                               45.0, "degrees"),
                   parameter(path, "clearance_m", 0.3))

    def places(self, zone: MeasuredEvent, size: CarSize) -> Iterator[Tuple[float, float, float]]:
        """Yield x and y of each place of a zone in the true Car's frame, and the direction of its radial in rad."""
        distances_m = np.arange(self.nearest_m, self.farthest_m + 1e-9, self.spacing_m)
        for number in range(math.ceil(360.0 / self.angle_deg - 1e-9)):
            clockwise_deg = number * self.angle_deg
            if ZONE_SIDES[round(clockwise_deg * len(ZONE_SIDES) / 360.0) % len(ZONE_SIDES)] != zone.side:
                continue
            (start_x, start_y), (along_x, along_y) = from_outline(math.radians(clockwise_deg), size)
            for distance_m in distances_m:
                x, y = start_x + distance_m * along_x, start_y + distance_m * along_y
                if _gap_m(x, y, size) >= self.clearance_m:
                    yield x, y, math.atan2(along_y, along_x)


def true_coverage(zone: MeasuredEvent, size: CarSize, model: ReactionModel, grid: ZoneGrid) -> float:
    """Return the part of a zone's area where at least half of the presses work; NaN for a zone without a place."""
    covered_m, whole_m = 0.0, 0.0
    for x, y, outward_rad in grid.places(zone, size):
        works = float(model.press(np.array([[x, y, zone.key_height_m]]), Attitude(outward_rad + math.pi))[0])
        # A place represents a piece of a ring, whose area is proportional to its radius.
        radius_m = math.hypot(x, y)
        whole_m += radius_m
        covered_m += radius_m if works >= _COVERED else 0.0
    return covered_m / whole_m if whole_m else math.nan


def _gap_m(x: float, y: float, size: CarSize) -> float:
    """Return the distance from the Car's outline."""
    return math.hypot(max(abs(x) - size.length_m / 2.0, 0.0), max(abs(y) - size.width_m / 2.0, 0.0))
