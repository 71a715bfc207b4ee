"""Objects and persons around the Car, and the ground below."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Tuple

from mtr_core.se2 import Pose2

from ..noise import stream
from .car_shape import CarShape


@dataclass(frozen=True)
class Pole:
    """Upright cylinder, 1.2 m high; x, y in world."""

    x_m: float
    y_m: float
    radius_m: float = 0.05


@dataclass(frozen=True)
class Cone:
    """Traffic cone, 0.75 m high, narrowing upwards; x, y in world."""

    x_m: float
    y_m: float
    foot_radius_m: float = 0.18
    top_radius_m: float = 0.03


@dataclass(frozen=True)
class Wall:
    """Upright box, 2 m high, along the x axis of its pose in world."""

    pose: Pose2
    length_m: float
    thickness_m: float = 0.2


@dataclass(frozen=True)
class ParkedCar:
    """Another car; pose of its centre in world."""

    pose: Pose2
    shape: CarShape = CarShape()


@dataclass(frozen=True)
class Walk:
    """Person who waits for a while and then walks to and fro between two points in world."""

    start: Tuple[float, float]
    end: Tuple[float, float]
    speed_mps: float = 1.2
    stands_s: float = 0.0
    # One of figures.FIGURES.
    figure: str = "person"


# Lengths of the ground's waves: long compared with the wheelbase of 0.26 m, so that the robot tilts with the ground.
WAVE_LENGTHS_M = (2.5, 3.5, 5.0, 7.0)


class Ground:
    """Height of uneven ground as a sum of waves in directions given by the seed."""

    def __init__(self, waves: List[Tuple[float, float, float, float]]):
        self._waves = waves

    def height_m(self, x_m: float, y_m: float) -> float:
        """Return the height at a place in world."""
        return sum(amplitude * math.sin(a * x_m + b * y_m + phase) for amplitude, a, b, phase in self._waves)


def uneven_ground(seed: int, tilt_rad: float) -> Ground:
    """Return ground whose steepest slope has a root mean square of tilt_rad over all places."""
    noise = stream(seed, "ground")
    waves = []
    for length_m in WAVE_LENGTHS_M:
        direction, phase = noise.uniform(0.0, 2.0 * math.pi, 2)
        number = 2.0 * math.pi / length_m
        # A wave's slope has the mean square (amplitude * number)^2 / 2; all waves have an equal share.
        amplitude = math.tan(tilt_rad) / number * math.sqrt(2.0 / len(WAVE_LENGTHS_M))
        waves.append((float(amplitude), float(number * math.cos(direction)), float(number * math.sin(direction)),
                      float(phase)))
    return Ground(waves)
