"""Motion of base_link in the physics at one instant."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Tuple

from mtr_core.se2 import Pose2

Vector = Tuple[float, float, float]
Matrix = Tuple[Vector, Vector, Vector]


class BaseState(NamedTuple):
    """Position in world, rotation world_from_base, linear velocity in world and angular velocity in world."""

    position: Vector
    rotation: Matrix
    velocity: Vector
    angular_velocity: Vector

    def point(self, x: float, y: float, z: float) -> Vector:
        """Return the world coordinates of a point in base_link."""
        turned = rotate(self.rotation, x, y, z)
        return self.position[0] + turned[0], self.position[1] + turned[1], self.position[2] + turned[2]

    def pose(self) -> Pose2:
        """Return world_from_base in the plane."""
        return Pose2(self.position[0], self.position[1], math.atan2(self.rotation[1][0], self.rotation[0][0]))

    def tilt_rad(self, gravity: Vector = (0.0, 0.0, -1.0)) -> float:
        """Return the angle between the robot's vertical and gravity, which is given in world."""
        x, y, z = rotate_back(self.rotation, *gravity)
        return math.atan2(math.hypot(x, y), -z)


def base_state(position: List[float], quaternion: List[float], velocity: List[float], spin: List[float]) -> BaseState:
    """Return the state from a free joint's coordinates; spin is the angular velocity in base_link."""
    rotation = matrix_of(quaternion)
    (x, y, z), (along, aside, up) = position, velocity
    return BaseState((x, y, z), rotation, (along, aside, up), rotate(rotation, *spin))


def matrix_of(quaternion: List[float]) -> Matrix:
    """Return the rotation matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def rotate(rotation: Matrix, x: float, y: float, z: float) -> Vector:
    """Return rotation @ (x, y, z)."""
    a, b, c = rotation
    return (a[0] * x + a[1] * y + a[2] * z, b[0] * x + b[1] * y + b[2] * z, c[0] * x + c[1] * y + c[2] * z)


def rotate_back(rotation: Matrix, x: float, y: float, z: float) -> Vector:
    """Return rotation transposed @ (x, y, z)."""
    a, b, c = rotation
    return (a[0] * x + b[0] * y + c[0] * z, a[1] * x + b[1] * y + c[1] * z, a[2] * x + b[2] * y + c[2] * z)


def mean_spin(before: List[float], after: List[float], duration_s: float) -> Vector:
    """Return the mean angular velocity, in the body, between two orientations given as quaternions (w, x, y, z)."""
    a, b, c, d = before
    e, f, g, h = after
    w = a * e + b * f + c * g + d * h
    x, y, z = a * f - b * e - c * h + d * g, a * g + b * h - c * e - d * f, a * h - b * g + c * f - d * e
    sine = math.sqrt(x * x + y * y + z * z)
    scale = (2.0 * math.atan2(sine, w) / sine if sine > 1e-12 else 2.0) / duration_s
    return x * scale, y * scale, z * scale
