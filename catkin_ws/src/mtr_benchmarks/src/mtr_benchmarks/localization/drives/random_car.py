"""Random Car of a seed, and another one parked next to it."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional

import numpy as np

from mtr_core.se2 import Pose2
from mtr_simulation.noise import stream
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.surroundings import ParkedCar

# Width as a function of the length of cars on the road, and its scatter in makers' data sheets.
LENGTH_M, WIDTH_M = (3.0, 6.0), (1.4, 2.2)
WIDTH_AT_3_M, WIDTH_PER_LENGTH, WIDTH_SIGMA_M = 1.55, 0.1, 0.1
WHEEL_RADIUS_M, CLEARANCE_M = (0.27, 0.36), (0.10, 0.35)
# Shares of the length; small cars have short overhangs.
MIN_WHEELBASE_SHARE, MAX_WHEELBASE_SHARE_AT_3_M, WHEELBASE_SHARE_PER_LENGTH = 0.54, 0.73, -0.025
MIN_WHEELBASE_M, MIN_BUMPERS_M = 1.87, 1.05
HAS_FITTING, HAS_NEIGHBOUR, KNOWS_SHEET = 0.25, 0.3, 0.5
LIDAR_HEIGHTS_M = (0.2, 0.3)
NEIGHBOUR_GAP_M, NEIGHBOUR_SHIFT_M, NEIGHBOUR_TURN_RAD = 0.6, 0.3, math.radians(3.0)
FRONT, REAR, LEFT, RIGHT = "front", "rear", "left", "right"


class RandomCar(NamedTuple):
    """Random Car of a seed.

    Attributes:
        lidar_height_m: height of the robot's LiDAR plane.
        rear_lidar: the robot has a rear LiDAR.
        knows_sheet: the laboratory has entered the Car's data sheet.
        neighbour: side on which another car is parked, too close for the robot to pass between; or None.
    """

    shape: CarShape
    lidar_height_m: float
    rear_lidar: bool
    knows_sheet: bool
    neighbour: Optional[str]


def random_car(seed: int) -> RandomCar:
    """Return the seed's Car; the same on every machine."""
    chance = stream(seed, "random car")
    shape = _shape(chance)
    beside = chance.choice((FRONT, REAR, LEFT, RIGHT)) if chance.random() < HAS_NEIGHBOUR else None
    return RandomCar(shape, float(chance.choice(LIDAR_HEIGHTS_M)), bool(chance.random() < 0.5),
                     bool(chance.random() < KNOWS_SHEET), None if beside is None else str(beside))


def neighbour_of(seed: int, shape: CarShape, side: str, world_from_car: Pose2) -> ParkedCar:
    """Return the other car, approximately parallel; poses in world."""
    chance = stream(seed, "neighbour")
    other = _shape(chance)
    shift, turn = chance.uniform(-NEIGHBOUR_SHIFT_M, NEIGHBOUR_SHIFT_M), chance.uniform(-1.0, 1.0) * NEIGHBOUR_TURN_RAD
    # A rotated car extends further towards its neighbour.
    along = 0.5 * (shape.length_m + other.length_m) + NEIGHBOUR_GAP_M + 0.5 * other.width_m * math.sin(abs(turn))
    across = 0.5 * (shape.width_m + other.width_m) + NEIGHBOUR_GAP_M + 0.5 * other.length_m * math.sin(abs(turn))
    x, y = {FRONT: (along, shift), REAR: (-along, shift), LEFT: (shift, across), RIGHT: (shift, -across)}[side]
    return ParkedCar(world_from_car @ Pose2(x, y, turn), other)


def _shape(chance: np.random.Generator) -> CarShape:
    length_m = chance.uniform(*LENGTH_M)
    width_m = np.clip(WIDTH_AT_3_M + WIDTH_PER_LENGTH * (length_m - LENGTH_M[0]) + chance.normal(0.0, WIDTH_SIGMA_M),
                      *WIDTH_M)
    max_share = MAX_WHEELBASE_SHARE_AT_3_M + WHEELBASE_SHARE_PER_LENGTH * (length_m - LENGTH_M[0])
    wheelbase_m = np.clip(chance.uniform(MIN_WHEELBASE_SHARE, max_share) * length_m, MIN_WHEELBASE_M,
                          length_m - MIN_BUMPERS_M)
    numbers = (length_m, width_m, chance.uniform(1.3, 2.0), wheelbase_m, chance.uniform(*WHEEL_RADIUS_M),
               chance.uniform(*CLEARANCE_M), _sometimes(chance, 0.5, 0.0, 0.15), chance.uniform(2.0, 8.0),
               chance.uniform(2.0, 8.0), _sometimes(chance, 0.5, 0.0, 0.08), _sometimes(chance, HAS_FITTING, 0.08, 0.2),
               _sometimes(chance, HAS_FITTING, 0.08, 0.2), _sometimes(chance, HAS_FITTING, 0.3, 0.6))
    return CarShape(*map(float, numbers))


def _sometimes(chance: np.random.Generator, share: float, low: float, high: float) -> float:
    """Return a value from low to high in the given share of the cases, else 0."""
    return chance.uniform(low, high) if chance.random() < share else 0.0
