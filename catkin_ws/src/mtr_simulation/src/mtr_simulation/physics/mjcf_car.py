"""MuJoCo model of a parked car: bumpers with rounded corners, sills, wheel arches, wheels, cabin and mirrors."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Tuple

from mtr_core.se2 import Pose2

from ..site.car_shape import (
    ARCH_HALF_LENGTH_M,
    SILL_INSET_M,
    TYRE_INSET_M,
    TYRE_WIDTH_M,
    UNDERCUT_TOP_M,
    CarShape,
    Point,
)

FRONT_TOP_M, REAR_TOP_M, SHOULDER_TOP_M, CABIN_FOOT_M = 0.78, 0.90, 0.80, 0.75
TUNNEL_HALF_WIDTH_M = 0.55
MIRROR_X_M, MIRROR_Z_M = 0.75, 1.0
MIRROR_HALF = (0.06, 0.10, 0.07)

SOLID = 'contype="1" conaffinity="1" group="1" rgba=".25 .3 .6 1"'
# Group 3: far above the LiDARs' plane, not asked for each beam.
UPPER = SOLID.replace('group="1"', 'group="3"')
RUBBER = 'contype="1" conaffinity="1" group="1" rgba=".1 .1 .1 1"'


def car_meshes(name: str, shape: CarShape) -> str:
    """Assets of the two bumpers."""
    return _bumper(f"{name}_front", shape, 1.0, FRONT_TOP_M) + _bumper(f"{name}_rear", shape, -1.0, REAR_TOP_M)


def car_body(name: str, shape: CarShape, world_from_car: Pose2) -> str:
    """Body with frame car: origin on the ground below the Car's centre."""
    pose = world_from_car
    geoms = "".join([*_bumpers(name), *_lower_body(shape), *_wheels(shape), *_cabin(shape)])
    return f'<body name="{name}" pos="{pose.x:.6f} {pose.y:.6f} 0" euler="0 0 {pose.heading:.9f}">{geoms}</body>'


def parked_car_body(name: str, shape: CarShape, world_from_car: Pose2) -> str:
    """A car far away: its outline as a box, which costs a beam less than bumpers and wheels."""
    pose = world_from_car
    middle, half = _between(0.0, SHOULDER_TOP_M)
    body = _box((0.0, 0.0, middle), (shape.length_m / 2.0, shape.width_m / 2.0, half))
    geoms = "".join([body, *_cabin(shape)])
    return f'<body name="{name}" pos="{pose.x:.6f} {pose.y:.6f} 0" euler="0 0 {pose.heading:.9f}">{geoms}</body>'


def _bumper(name: str, shape: CarShape, end: float, top_m: float) -> str:
    """Convex hull of the bumper's plans at its lower edge, at the top of the undercut and at its upper edge."""
    heights = sorted({shape.clearance_m, max(shape.clearance_m, UNDERCUT_TOP_M), top_m})
    corners: List[Tuple[Point, float]] = [(corner, z) for z in heights for corner in shape.bumper_plan(end, z)]
    vertices = " ".join(f"{x:.4f} {y:.4f} {z:.4f}" for (x, y), z in corners)
    return f'<mesh name="{name}" vertex="{vertices}"/>'


def _box(centre: Tuple[float, float, float], half: Tuple[float, float, float], kind: str = SOLID) -> str:
    (x, y, z), (a, b, c) = centre, half
    return f'<geom type="box" pos="{x:.4f} {y:.4f} {z:.4f}" size="{a:.4f} {b:.4f} {c:.4f}" {kind}/>'


def _between(low: float, high: float) -> Tuple[float, float]:
    """Centre and half height of a box between two heights."""
    return (low + high) / 2.0, (high - low) / 2.0


# A mesh geom is placed at the mesh's own frame: MuJoCo re-centres the vertices and keeps the geom where they were.
def _bumpers(name: str) -> List[str]:
    return [f'<geom type="mesh" mesh="{name}_{end}" {SOLID}/>' for end in ("front", "rear")]


def _lower_body(shape: CarShape) -> List[str]:
    half_axles, half_width = shape.wheelbase_m / 2.0, shape.width_m / 2.0
    middle, half = _between(shape.clearance_m + shape.sill_rise_m, SHOULDER_TOP_M)
    sill_half = (half_axles - ARCH_HALF_LENGTH_M, half_width - SILL_INSET_M, half)
    parts = [_box((0.0, 0.0, middle), sill_half)]
    tunnel_middle, tunnel_half = _between(shape.clearance_m + 0.05, SHOULDER_TOP_M)
    arch_top = 2.0 * shape.wheel_radius_m + 0.05
    shoulder_middle, shoulder_half = _between(arch_top, SHOULDER_TOP_M)
    for x in (half_axles, -half_axles):
        parts.append(_box((x, 0.0, tunnel_middle), (ARCH_HALF_LENGTH_M + 0.02, TUNNEL_HALF_WIDTH_M, tunnel_half)))
        parts.append(_box((x, 0.0, shoulder_middle),
                          (ARCH_HALF_LENGTH_M + 0.02, half_width - SILL_INSET_M, shoulder_half), UPPER))
    return parts


def _wheels(shape: CarShape) -> List[str]:
    y = shape.width_m / 2.0 - TYRE_INSET_M - TYRE_WIDTH_M / 2.0
    radius = shape.wheel_radius_m
    return [f'<geom type="cylinder" pos="{sx * shape.wheelbase_m / 2.0:.4f} {sy * y:.4f} {radius:.4f}" '
            f'euler="1.5707963268 0 0" size="{radius:.4f} {TYRE_WIDTH_M / 2.0:.4f}" {RUBBER}/>'
            for sx in (1, -1) for sy in (1, -1)]


def _cabin(shape: CarShape) -> List[str]:
    middle, half = _between(CABIN_FOOT_M, shape.height_m)
    cabin = _box((-0.25, 0.0, middle), (shape.length_m * 0.255, shape.width_m / 2.0 - 0.2, half), UPPER)
    mirror_y = shape.width_m / 2.0 + 0.08
    return [cabin, *(_box((MIRROR_X_M, side * mirror_y, MIRROR_Z_M), MIRROR_HALF, UPPER) for side in (1, -1))]
