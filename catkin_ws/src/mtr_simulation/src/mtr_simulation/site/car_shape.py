"""Body of a car: its dimensions, and its outline at any height."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Tuple

from mtr_core.errors import check_range
from mtr_core.parameters import ParameterSet, number

Point = Tuple[float, float]

# Half the length of a wheel arch, where bumpers begin and sills end.
ARCH_HALF_LENGTH_M = 0.40
SILL_INSET_M = 0.02
TYRE_WIDTH_M = 0.21
TYRE_INSET_M = 0.025  # tyre's outer face from the Car's side
# Below this height the bumpers recede towards their lower edge.
UNDERCUT_TOP_M = 0.28
CORNER_POINTS = 7


@dataclass(frozen=True)
class CarShape(ParameterSet):
    """Body of a car; the robot must find length and width without mirrors.

    Attributes:
        wheelbase_m: distance of the axles, less than length_m - 1.
        clearance_m: gap between ground and body; a LiDAR below it sees only the wheels.
        sill_rise_m: how much higher the sills between the wheels begin than the bumpers.
        front_exponent: exponent of the superellipse of the front bumper's plan; 2 is round, 6 nearly a box.
        rear_exponent: exponent of the rear bumper's plan.
        undercut_m: how far the bumpers' lower edge is set back.
        tow_bar_m: protrusion of a tow bar at the rear; 0: none.
        low_mirrors_m: protrusion of a low car's mirrors, or of steps, on both sides at a LiDAR's height; 0: none.
        tailgate_m: protrusion of a lowered tailgate at the rear, above the LiDAR plane; 0: none.
    """

    length_m: float = number(4.5, 3.0, 6.0, "m")
    width_m: float = number(1.8, 1.4, 2.2, "m")
    height_m: float = number(1.45, 1.2, 2.2, "m")
    wheelbase_m: float = number(2.65, 1.5, 5.0, "m")
    wheel_radius_m: float = number(0.32, 0.25, 0.45, "m")
    clearance_m: float = number(0.24, 0.1, 0.4, "m")
    sill_rise_m: float = number(0.0, 0.0, 0.2, "m")
    front_exponent: float = number(3.0, 2.0, 8.0, "(exponent)")
    rear_exponent: float = number(4.0, 2.0, 8.0, "(exponent)")
    undercut_m: float = number(0.0, 0.0, 0.1, "m")
    tow_bar_m: float = number(0.0, 0.0, 0.3, "m")
    low_mirrors_m: float = number(0.0, 0.0, 0.3, "m")
    tailgate_m: float = number(0.0, 0.0, 0.6, "m")

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("wheelbase_m", self.wheelbase_m, 1.5, self.length_m - 1.0, "m")

    def inset_m(self, height_m: float) -> float:
        """Return how far the bumpers are set back at a height, relative to the Car's length."""
        depth = UNDERCUT_TOP_M - self.clearance_m
        return self.undercut_m * min(1.0, max(0.0, UNDERCUT_TOP_M - height_m) / depth) if depth > 0.0 else 0.0

    def bumper_plan(self, end: float, height_m: float) -> List[Point]:
        """Return the corners of the front (end 1) or rear (-1) bumper at a height, from its left to its right."""
        exponent = self.front_exponent if end > 0.0 else self.rear_exponent
        depth = 0.5 * (self.length_m - self.wheelbase_m) - ARCH_HALF_LENGTH_M
        inset = self.inset_m(height_m)
        left = [(end * (0.5 * self.length_m - inset - depth * back), (0.5 * self.width_m - inset) * aside)
                for back, aside in _quarter(exponent)]
        return left + [(x, -y) for x, y in reversed(left[:-1])]


class Size(NamedTuple):
    """Length and width in m of the section of the Car with a horizontal plane."""

    length_m: float
    width_m: float
    only_wheels: bool


def size_at(shape: CarShape, height_m: float) -> Size:
    """Return the size that a LiDAR in that plane can find at best; undercut bumpers are set back behind sills and
    tyres."""
    if height_m >= shape.clearance_m:
        inset = shape.inset_m(height_m)
        beside = [SILL_INSET_M] if height_m >= shape.clearance_m + shape.sill_rise_m else []
        beside += [TYRE_INSET_M] if height_m < 2.0 * shape.wheel_radius_m else []
        return Size(shape.length_m - 2.0 * inset, shape.width_m - 2.0 * min([inset, *beside]), only_wheels=False)
    chord = max(0.0, shape.wheel_radius_m**2 - (shape.wheel_radius_m - height_m) ** 2) ** 0.5
    return Size(shape.wheelbase_m + 2.0 * chord, shape.width_m - 2.0 * TYRE_INSET_M, only_wheels=True)


def _quarter(exponent: float) -> List[Point]:
    """Return a superellipse from its side to its tip: (share of the depth back from the tip, share of the half
    width)."""
    shares = [1.0 - (step / CORNER_POINTS) ** 2 for step in range(CORNER_POINTS + 1)]
    return [(1.0 - (1.0 - share**exponent) ** (1.0 / exponent), share) for share in shares]


# Sizes of common cars of each class. The LiDAR plane at 0.2 m meets the hatchback's body and the others' wheels. At 0.3
# m it meets all bumpers, but not the van's sills.
CAR_SHAPES: Dict[str, CarShape] = {
    "default": CarShape(),
    "hatchback": CarShape(4.28, 1.79, 1.46, 2.63, 0.316, 0.17, 0.0, 2.6, 3.5, 0.02),
    "sedan": CarShape(4.85, 1.85, 1.44, 2.85, 0.33, 0.22, 0.0, 2.8, 3.5, 0.02),
    "small": CarShape(3.57, 1.63, 1.49, 2.3, 0.29, 0.16, 0.0, 2.4, 3.0, 0.02),
    "van": CarShape(5.1, 1.95, 1.97, 3.15, 0.34, 0.26, 0.08, 3.5, 7.0, 0.01),
    "suv": CarShape(length_m=4.7, width_m=1.9, height_m=1.7, wheel_radius_m=0.36, clearance_m=0.34),
}
