"""Solids of a parked car: bumpers with rounded corners, sills, wheel arches, wheels, cabin and mirrors."""
# SPDX-License-Identifier: Apache-2.0
from typing import Iterator, List, Tuple

from mtr_core.se2 import Pose2

from .car_shape import (
    ARCH_HALF_LENGTH_M,
    SILL_INSET_M,
    TYRE_INSET_M,
    TYRE_WIDTH_M,
    UNDERCUT_TOP_M,
    CarShape,
)
from .shapes import Body, Box, Cylinder, Hull, Part, Surface

FRONT_TOP_M, REAR_TOP_M, SHOULDER_TOP_M, CABIN_FOOT_M = 0.78, 0.90, 0.80, 0.75
TUNNEL_HALF_WIDTH_M = 0.55
MIRROR_X_M, MIRROR_Z_M = 0.75, 1.0
MIRROR_HALF = (0.06, 0.10, 0.07)
# Optional parts of a shape: a bar of 6 cm, parts between 0.16 and 0.40 m, and a plate; each begins inside the body.
ROOT_M = 0.1
TOW_BAR_Z_M, TOW_BAR_HALF_WIDTH_M, TOW_BAR_HALF_HEIGHT_M = 0.38, 0.03, 0.1
LOW_MIRROR_X_M, LOW_MIRROR_Z_M, LOW_MIRROR_HALF_LENGTH_M, LOW_MIRROR_HALF_HEIGHT_M = 0.65, 0.28, 0.08, 0.12
TAILGATE_Z_M, TAILGATE_SIDE_M, TAILGATE_HALF_HEIGHT_M = 0.65, 0.2, 0.03


def car_body(name: str, shape: CarShape, world_from_car: Pose2) -> Body:
    """Return the body with frame car: origin on the ground below the Car's centre."""
    return Body(name, world_from_car, (
        _bumper(f"{name}_front", shape, 1.0, FRONT_TOP_M), _bumper(f"{name}_rear", shape, -1.0, REAR_TOP_M),
        *_lower_body(shape), *_wheels(shape), *_cabin(shape), *_fittings(shape)))


def parked_car_body(name: str, shape: CarShape, world_from_car: Pose2) -> Body:
    """Return a distant car: its outline as a box, which costs less per beam than bumpers and wheels."""
    middle, half = _between(0.0, SHOULDER_TOP_M)
    outline = Part(Box((shape.length_m / 2.0, shape.width_m / 2.0, half)), (0.0, 0.0, middle))
    return Body(name, world_from_car, (outline, *_cabin(shape)))


def _bumper(name: str, shape: CarShape, end: float, top_m: float) -> Part:
    """Return the convex hull of the bumper's plans at its lower edge, the top of the undercut, and its upper edge."""
    heights = sorted({shape.clearance_m, max(shape.clearance_m, UNDERCUT_TOP_M), top_m})
    return Part(Hull(name, tuple((x, y, z) for z in heights for x, y in shape.bumper_plan(end, z))))


def _between(low: float, high: float) -> Tuple[float, float]:
    """Return centre and half height of a box between two heights."""
    return (low + high) / 2.0, (high - low) / 2.0


def _lower_body(shape: CarShape) -> List[Part]:
    half_axles, half_width = shape.wheelbase_m / 2.0, shape.width_m / 2.0
    middle, half = _between(shape.clearance_m + shape.sill_rise_m, SHOULDER_TOP_M)
    parts = [Part(Box((half_axles - ARCH_HALF_LENGTH_M, half_width - SILL_INSET_M, half)), (0.0, 0.0, middle))]
    tunnel_middle, tunnel_half = _between(shape.clearance_m + 0.05, SHOULDER_TOP_M)
    shoulder_middle, shoulder_half = _between(2.0 * shape.wheel_radius_m + 0.05, SHOULDER_TOP_M)
    for x in (half_axles, -half_axles):
        parts.append(Part(Box((ARCH_HALF_LENGTH_M + 0.02, TUNNEL_HALF_WIDTH_M, tunnel_half)), (x, 0.0, tunnel_middle)))
        if shoulder_half > 0.0:
            parts.append(Part(Box((ARCH_HALF_LENGTH_M + 0.02, half_width - SILL_INSET_M, shoulder_half)),
                              (x, 0.0, shoulder_middle), surface=Surface.UPPER))
    return parts


def _wheels(shape: CarShape) -> List[Part]:
    y = shape.width_m / 2.0 - TYRE_INSET_M - TYRE_WIDTH_M / 2.0
    wheel = Cylinder(shape.wheel_radius_m, TYRE_WIDTH_M / 2.0)
    return [Part(wheel, (end * shape.wheelbase_m / 2.0, side * y, shape.wheel_radius_m), is_lying=True,
                 surface=Surface.RUBBER) for end in (1, -1) for side in (1, -1)]


def _cabin(shape: CarShape) -> List[Part]:
    middle, half = _between(CABIN_FOOT_M, shape.height_m)
    cabin = Box((shape.length_m * 0.255, shape.width_m / 2.0 - 0.2, half))
    mirror_y = shape.width_m / 2.0 + 0.08
    return [Part(cabin, (-0.25, 0.0, middle), surface=Surface.UPPER),
            *(Part(Box(MIRROR_HALF), (MIRROR_X_M, side * mirror_y, MIRROR_Z_M), surface=Surface.UPPER)
              for side in (1, -1))]


def _fittings(shape: CarShape) -> Iterator[Part]:
    rear_x, side_y = -shape.length_m / 2.0, shape.width_m / 2.0
    if shape.tow_bar_m > 0.0:
        half = (shape.tow_bar_m + ROOT_M) / 2.0
        yield Part(Box((half, TOW_BAR_HALF_WIDTH_M, TOW_BAR_HALF_HEIGHT_M)), (rear_x + ROOT_M - half, 0.0, TOW_BAR_Z_M))
    if shape.low_mirrors_m > 0.0:
        half = (shape.low_mirrors_m + ROOT_M) / 2.0
        yield from (Part(Box((LOW_MIRROR_HALF_LENGTH_M, half, LOW_MIRROR_HALF_HEIGHT_M)),
                         (LOW_MIRROR_X_M, side * (side_y - ROOT_M + half), LOW_MIRROR_Z_M)) for side in (1, -1))
    if shape.tailgate_m > 0.0:
        half = (shape.tailgate_m + ROOT_M) / 2.0
        yield Part(Box((half, side_y - TAILGATE_SIDE_M, TAILGATE_HALF_HEIGHT_M)),
                   (rear_x + ROOT_M - half, 0.0, TAILGATE_Z_M), surface=Surface.UPPER)
