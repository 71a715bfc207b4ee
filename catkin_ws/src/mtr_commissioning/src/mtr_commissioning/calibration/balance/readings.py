"""Readings of scales and of a tilt table, and the centre of mass from each. Pure."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple

from ..readings import ReadingsUnusable

# A smaller rise changes the loads by less than the resolution of scales.
LEAST_RISE_M = 0.015
# Sums of the loads that differ by more than this percentage of the mass contradict each other.
SUM_PERCENT = 2.0
SUM_SHARE = SUM_PERCENT / 100.0
# Minimum remaining load of the raised axle; with less the robot may tip backwards.
LEAST_LOAD_SHARE = 0.25
# 1 sigma of a block's height and of the angle of a tilt table.
BLOCK_SIGMA_M, TILT_SIGMA_DEG = 0.0005, 0.3
MM_PER_M = 1000.0


class Chassis(NamedTuple):
    """Positions of the wheels' contact points, m: between the axles, between the sides; radius of a wheel."""

    base_m: float
    track_m: float
    radius_m: float


class Height(NamedTuple):
    """Height of the centre of mass above ground with its 1 sigma, m, at a height of the key."""

    key_height_m: float
    centre_m: float
    sigma_m: float


@dataclass(frozen=True)
class Level:
    """Loads on level ground, kg: both front wheels, both rear wheels, both left wheels, both right wheels."""

    front_kg: float
    rear_kg: float
    left_kg: float
    right_kg: float

    def __post_init__(self) -> None:
        _refuse_contradiction(self.front_kg + self.rear_kg, self.left_kg + self.right_kg)

    @property
    def mass_kg(self) -> float:
        """Mean of both sums."""
        return 0.5 * (self.front_kg + self.rear_kg + self.left_kg + self.right_kg)

    def ahead_m(self, chassis: Chassis) -> float:
        """Return the distance of the centre of mass ahead of the middle between the axles."""
        return 0.5 * chassis.base_m * (self.front_kg - self.rear_kg) / (self.front_kg + self.rear_kg)

    def left_m(self, chassis: Chassis) -> float:
        """Return the distance of the centre of mass to the left of the middle."""
        return 0.5 * chassis.track_m * (self.left_kg - self.right_kg) / (self.left_kg + self.right_kg)


@dataclass(frozen=True)
class Raised:
    """Loads with the front wheels higher than the rear ones, kg; wheels roll freely."""

    key_height_m: float
    rise_m: float
    front_kg: float
    rear_kg: float

    def height(self, chassis: Chassis, mass_kg: float, ahead_m: float, step_kg: float) -> Height:
        """Return the height of the centre of mass from the load that moved to the rear wheels.

        Moments about the rear axle: front load * base = mass * (distance to the axle - height above the axle * tan).

        Raises:
            ReadingsUnusable: the rise is too small or too large, or the loads contradict the mass.
        """
        _refuse_contradiction(self.front_kg + self.rear_kg, mass_kg)
        if not LEAST_RISE_M <= self.rise_m < chassis.base_m:
            raise ReadingsUnusable(f"The front wheels were {MM_PER_M * self.rise_m:.0f} mm higher; at least "
                                   f"{MM_PER_M * LEAST_RISE_M:.0f} mm and less than the wheels' base are needed.")
        level_kg = mass_kg * (0.5 + ahead_m / chassis.base_m)
        if self.front_kg < LEAST_LOAD_SHARE * level_kg:
            raise ReadingsUnusable(f"The front wheels carry {self.front_kg:.1f} kg of {level_kg:.1f} kg: the robot is "
                                   "near to tipping. Use a lower block.")
        tangent = math.tan(math.asin(self.rise_m / chassis.base_m))
        # The front load relative to the sum of both is free of the scales' common error.
        front_share = self.front_kg / (self.front_kg + self.rear_kg)
        above_axle_m = (0.5 * chassis.base_m + ahead_m - chassis.base_m * front_share) / tangent
        of_loads_m = chassis.base_m * step_kg / math.sqrt(12.0) / (mass_kg * tangent)
        of_block_m = abs(above_axle_m) * BLOCK_SIGMA_M / self.rise_m
        return Height(self.key_height_m, chassis.radius_m + above_axle_m, math.hypot(of_loads_m, of_block_m))


@dataclass(frozen=True)
class Tilt:
    """Angle of a tilt table at which the upper wheels lose their load. across: tilted to a side, not backwards."""

    key_height_m: float
    angle_deg: float
    across: bool

    def height(self, chassis: Chassis, ahead_m: float, left_m: float) -> Height:
        """Return the height of the centre of mass, which is then above the lower wheels' contact points.

        The lower wheels are the rear ones if tilted backwards, the right ones if tilted across.

        Raises:
            ReadingsUnusable: the angle is impossible.
        """
        if not 1.0 <= self.angle_deg <= 60.0:
            raise ReadingsUnusable(f"The angle is {self.angle_deg:g} degrees; it has to be between 1 and 60.")
        lever_m = 0.5 * chassis.track_m + left_m if self.across else 0.5 * chassis.base_m + ahead_m
        angle_rad = math.radians(self.angle_deg)
        centre_m = lever_m / math.tan(angle_rad)
        return Height(self.key_height_m, centre_m, lever_m * math.radians(TILT_SIGMA_DEG) / math.sin(angle_rad) ** 2)


def _refuse_contradiction(sum_kg: float, other_kg: float) -> None:
    if not (min(sum_kg, other_kg) > 0.0 and abs(sum_kg - other_kg) <= SUM_SHARE * max(sum_kg, other_kg)):
        raise ReadingsUnusable(f"The loads add up to {sum_kg:.2f} kg and to {other_kg:.2f} kg; they may differ by "
                               f"{SUM_PERCENT:.0f} %. Level the scales, set them to zero, and weigh again.")
