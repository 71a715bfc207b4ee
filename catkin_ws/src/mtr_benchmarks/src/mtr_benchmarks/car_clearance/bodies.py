"""True bodies of Cars with different ends: solids between two heights, and their sections with a horizontal plane."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Iterator, List, NamedTuple, Tuple

Point = Tuple[float, float]
ARCH_M, WHEEL_WIDTH_M, TYRE_INSET_M, SILL_INSET_M = 0.40, 0.21, 0.025, 0.02
# Top of the bumper's lower part, which may be set back, and top of the body.
LOWER_TOP_M, BODY_TOP_M = 0.45, 0.80
CABIN_INSET_M, NOSE_POINTS = 0.2, 6
MIRROR_HALF_LENGTH_M, MIRROR_HEIGHTS_M = 0.08, (0.90, 1.15)
SPARE_WHEEL_M, SPARE_HALF_WIDTH_M, SPARE_HEIGHTS_M = 0.20, 0.36, (0.60, 1.30)
FITTING_ROOT_M = 0.1


class Solid(NamedTuple):
    """Convex outline in the Car's frame between two heights, m. wheel_radius_m: for a round wheel; else 0."""

    corners: Tuple[Point, ...]
    low_m: float
    high_m: float
    wheel_radius_m: float = 0.0


class Fitting(NamedTuple):
    """Part that protrudes behind the Car beyond its length: protrusion, half width and heights, m."""

    out_m: float
    half_width_m: float
    low_m: float
    high_m: float


@dataclass(frozen=True)
class TrueCar:
    """True Car; the origin of its frame is midway between front and rear, without fittings.

    Attributes:
        clearance_m: lower edge of bumpers and sills; a LiDAR plane below it shows only the wheels.
        front_inset_m, rear_inset_m: how far the lower part of the bumper is set back.
        mirror_m: protrusion of the mirrors from the sides.
        spare_wheel: a spare wheel is mounted at the rear and counts as part of the length.
    """

    length_m: float
    width_m: float
    height_m: float
    front_overhang_m: float
    wheelbase_m: float
    wheel_radius_m: float
    clearance_m: float
    front_inset_m: float
    rear_inset_m: float
    mirror_m: float
    spare_wheel: bool
    fittings: Tuple[Fitting, ...] = ()

    @property
    def front_axle_m(self) -> float:
        """x coordinate of the front axle."""
        return 0.5 * self.length_m - self.front_overhang_m

    @property
    def rear_axle_m(self) -> float:
        """x coordinate of the rear axle."""
        return self.front_axle_m - self.wheelbase_m

    def solids(self) -> List[Solid]:
        """Return all solids of the body."""
        return [*self._bumpers(), *self._middle(), *self._wheels(), *self._upper(), *self._fittings()]

    def section(self, height_m: float) -> List[Tuple[Point, ...]]:
        """Return the outlines of the section at a height."""
        return [_met(solid, height_m) for solid in self.solids() if solid.low_m <= height_m < solid.high_m]

    def _bumpers(self) -> Iterator[Solid]:
        rear_m = 0.5 * self.length_m - (SPARE_WHEEL_M if self.spare_wheel else 0.0)
        for sign, tip_m, arch_m, inset_m in (
                (1.0, 0.5 * self.length_m, self.front_axle_m + ARCH_M, self.front_inset_m),
                (-1.0, rear_m, ARCH_M - self.rear_axle_m, self.rear_inset_m)):
            for low_m, high_m, back_m in ((self.clearance_m, LOWER_TOP_M, inset_m), (LOWER_TOP_M, BODY_TOP_M, 0.0)):
                yield Solid(_nose(sign, arch_m, tip_m - back_m, 0.5 * self.width_m), low_m, high_m)

    def _middle(self) -> Iterator[Solid]:
        half_m = 0.5 * self.width_m
        yield Solid(_box(self.rear_axle_m + ARCH_M, self.front_axle_m - ARCH_M, half_m - SILL_INSET_M),
                    self.clearance_m, BODY_TOP_M)
        shoulder_m = 2.0 * self.wheel_radius_m + 0.05
        if shoulder_m < BODY_TOP_M:
            yield Solid(_box(self.rear_axle_m - ARCH_M, self.front_axle_m + ARCH_M, half_m), shoulder_m, BODY_TOP_M)

    def _wheels(self) -> Iterator[Solid]:
        out_m = 0.5 * self.width_m - TYRE_INSET_M
        for x in (self.front_axle_m, self.rear_axle_m):
            for low, high in ((out_m - WHEEL_WIDTH_M, out_m), (-out_m, WHEEL_WIDTH_M - out_m)):
                yield Solid(_rectangle(x - self.wheel_radius_m, x + self.wheel_radius_m, low, high), 0.0,
                            2.0 * self.wheel_radius_m, self.wheel_radius_m)

    def _upper(self) -> Iterator[Solid]:
        half_m, mirror_x = 0.5 * self.width_m, self.front_axle_m - 0.55
        yield Solid(_box(self.rear_axle_m - ARCH_M, self.front_axle_m - 0.3, half_m - CABIN_INSET_M), BODY_TOP_M,
                    self.height_m)
        reach_m = half_m + self.mirror_m
        for low, high in ((half_m - CABIN_INSET_M, reach_m), (-reach_m, CABIN_INSET_M - half_m)):
            yield Solid(_rectangle(mirror_x - MIRROR_HALF_LENGTH_M, mirror_x + MIRROR_HALF_LENGTH_M, low, high),
                        *MIRROR_HEIGHTS_M)
        if self.spare_wheel:
            yield Solid(_box(-0.5 * self.length_m, SPARE_WHEEL_M - 0.5 * self.length_m, SPARE_HALF_WIDTH_M),
                        *SPARE_HEIGHTS_M)

    def _fittings(self) -> Iterator[Solid]:
        rear_m = -0.5 * self.length_m
        for each in self.fittings:
            yield Solid(_box(rear_m - each.out_m, rear_m + FITTING_ROOT_M, each.half_width_m), each.low_m, each.high_m)


def _rectangle(low_x: float, high_x: float, low_y: float, high_y: float) -> Tuple[Point, ...]:
    return (high_x, high_y), (low_x, high_y), (low_x, low_y), (high_x, low_y)


def _box(low_x: float, high_x: float, half_width_m: float) -> Tuple[Point, ...]:
    return _rectangle(low_x, high_x, -half_width_m, half_width_m)


def _nose(sign: float, arch_m: float, tip_m: float, half_width_m: float) -> Tuple[Point, ...]:
    """Return a superellipse from the wheel arch to the tip and back."""
    depth_m = tip_m - arch_m
    left = [(arch_m + depth_m * math.cos(angle) ** 0.5, half_width_m * math.sin(angle) ** 0.5)
            for angle in (0.5 * math.pi * step / NOSE_POINTS for step in range(NOSE_POINTS, -1, -1))]
    return tuple((sign * x, y) for x, y in (*left, *((x, -y) for x, y in reversed(left[:-1]))))


def _met(solid: Solid, height_m: float) -> Tuple[Point, ...]:
    """Return the section of a solid; for a wheel, the rectangle over the chord at that height."""
    if not solid.wheel_radius_m:
        return solid.corners
    radius_m = solid.wheel_radius_m
    chord_m = math.sqrt(max(0.0, radius_m ** 2 - (radius_m - height_m) ** 2))
    xs, ys = zip(*solid.corners)
    middle_m = 0.5 * (min(xs) + max(xs))
    return _rectangle(middle_m - chord_m, middle_m + chord_m, min(ys), max(ys))
