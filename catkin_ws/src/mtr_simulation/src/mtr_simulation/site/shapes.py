"""What a physics engine has to know of a thing on the site: solids of simple form, and where they stand."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import NamedTuple, Tuple, Union

from mtr_core.se2 import Pose2

Vector = Tuple[float, float, float]


class Surface(enum.Enum):
    """Of a solid; what is upper stands far above the LiDARs' plane."""

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
    """Convex hull of points in m; the name is its own on the whole site."""

    name: str
    points: Tuple[Vector, ...]


class Part(NamedTuple):
    """One solid of a body.

    Attributes:
        centre: of its frame in the body, in m.
        yaw_rad: of its frame in the body.
        is_lying: its z axis is the body's y axis: a wheel.
    """

    form: Union[Box, Cylinder, Hull]
    centre: Vector = (0.0, 0.0, 0.0)
    yaw_rad: float = 0.0
    is_lying: bool = False
    surface: Surface = Surface.PAINT


class Body(NamedTuple):
    """What does not move in itself; pose of its frame, on the ground, in world."""

    name: str
    pose: Pose2
    parts: Tuple[Part, ...]
