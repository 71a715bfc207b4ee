"""Bodies on the site for a physics engine: simple solids and their places."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import NamedTuple, Tuple, Union

from mtr_core.se2 import Pose2

Vector = Tuple[float, float, float]


class Surface(enum.Enum):
    """Surface of a solid; upper parts are far above the LiDAR plane."""

    PAINT = "paint"
    UPPER = "upper"
    RUBBER = "rubber"


class Box(NamedTuple):
    """Half the sides along x, y and z, in m."""

    half: Vector


class Cylinder(NamedTuple):
    """Radius and half the length, in m; its axis is z."""

    radius_m: float
    half_length_m: float


class Hull(NamedTuple):
    """Convex hull of points in m; the name is unique on the site."""

    name: str
    points: Tuple[Vector, ...]


class Part(NamedTuple):
    """One solid of a body.

    Attributes:
        centre: position of its frame in the body, in m.
        yaw_rad: yaw of its frame in the body.
        is_lying: its z axis is the body's y axis, as for a wheel.
    """

    form: Union[Box, Cylinder, Hull]
    centre: Vector = (0.0, 0.0, 0.0)
    yaw_rad: float = 0.0
    is_lying: bool = False
    surface: Surface = Surface.PAINT


class Body(NamedTuple):
    """Rigid body; pose of its frame, on the ground, in world."""

    name: str
    pose: Pose2
    parts: Tuple[Part, ...]
