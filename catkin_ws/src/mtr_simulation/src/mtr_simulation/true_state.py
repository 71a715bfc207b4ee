"""True state of robot and key, for the evaluation of results and never for the robot."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Tuple

from mtr_core.se2 import Pose2

Vector = Tuple[float, float, float]


class TrueState(NamedTuple):
    """True state at one tick; frame car has its origin on the ground below the true Car's centre.

    Attributes:
        time_ns: simulated time.
        world_from_base: pose of base_link in world.
        car_from_base: pose of base_link in frame car.
        key_in_world: m, z above ground.
        key_in_car: m, z above ground.
        linear_mps: speed along base_link x.
        lateral_mps: speed along base_link y.
        angular_radps: turning rate.
        tilt_rad: angle between the robot's vertical and gravity.
        lift_height_m: above the lower stop.
    """

    time_ns: int
    world_from_base: Pose2
    car_from_base: Pose2
    key_in_world: Vector
    key_in_car: Vector
    linear_mps: float
    lateral_mps: float
    angular_radps: float
    tilt_rad: float
    lift_height_m: float
