"""Convex outline of the collision shapes from above."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import TYPE_CHECKING, Any, Iterable, List, Tuple

import numpy as np
from shapely.geometry import MultiPoint
from shapely.geometry.polygon import orient

from mtr_core.errors import ConfigurationError

from .urdf_tree import DIGITS, Place

if TYPE_CHECKING:
    from .urdf_tree import Array

Point = Tuple[float, float]
# Number of corners of the polygon that circumscribes a round shape.
ROUND_CORNERS = 16


def corners_from_above(link: str, place: Place, geometry: Any) -> List[Point]:
    """Return points whose convex hull is the shape from above; ConfigurationError for a shape without a size."""
    kind = type(geometry).__name__
    if kind == "Box":
        points = _box(*geometry.size)
    elif kind == "Cylinder":
        points = _cylinder(geometry.radius, geometry.length)
    elif kind == "Sphere":
        points = _cylinder(geometry.radius, 2.0 * geometry.radius)
    else:
        raise ConfigurationError(f"The collision geometry of {link} in robot_description is a {kind.lower()}; allowed "
                                 "are box, cylinder and sphere.")
    seen = np.round(points @ place.rotation.T + place.position, DIGITS)[:, :2] + 0.0
    return [(float(x), float(y)) for x, y in seen]


def convex_hull(points: Iterable[Point]) -> Tuple[Point, ...]:
    """Return the corners counterclockwise from the rearmost one; ConfigurationError for a shape without an area."""
    hull = MultiPoint(list(points)).convex_hull
    if not hull.area > 0.0:
        raise ConfigurationError("The collision geometry in robot_description has no area from above; allowed are "
                                 "boxes, cylinders and spheres of more than 0 m.")
    ring = orient(hull).exterior.coords[:-1]
    first = ring.index(min(ring))
    return tuple(ring[first:] + ring[:first])


def _box(length: float, width: float, height: float) -> "Array":
    halves = (-0.5, 0.5)
    return np.array([(x * length, y * width, z * height) for x in halves for y in halves for z in halves])


def _cylinder(radius: float, length: float) -> "Array":
    # The polygon touches the circle at the axes, so that its extent there equals the radius.
    around = radius / math.cos(math.pi / ROUND_CORNERS)
    angles = 2.0 * math.pi * (np.arange(ROUND_CORNERS) + 0.5) / ROUND_CORNERS
    ring = np.column_stack((around * np.cos(angles), around * np.sin(angles)))
    return np.vstack([np.column_stack((ring, np.full(ROUND_CORNERS, z))) for z in (-0.5 * length, 0.5 * length)])
