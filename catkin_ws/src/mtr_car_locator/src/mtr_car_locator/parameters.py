"""Parameters of the car locator."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2


@dataclass(frozen=True)
class LocatorParameters(ParameterSet):
    """What the Car locator is started with.

    Attributes:
        start_x_m: where the Operator puts the robot, in the Car's frame.
        start_y_m: the same, to the Car's left.
        start_heading_rad: the robot's heading there; towards the Car's centre by default.
        expected_length_m: length of an ordinary Car.
        expected_width_m: width of an ordinary Car.
        size_tolerance_m: a length or width farther from the expected one is not believed.
        position_tolerance_m: the Car's centre is not believed farther from where the starting place puts it.
        drift_limit_m: when the first and the last look at the Car differ by more, neither is believed.
        prior_margin_m: added around the expected Car, for the planner, before it has been seen.
        seen_margin_m: the same after the first sides have been seen.
        ring_distance_m: distance from the Car at which the robot goes round it.
        arrival_m: so close to a place of the ring the robot is sent to the next one.
        look_first_s: standing look at the Car before the way round it is laid.
        front_lidar_x_m: front LiDAR ahead of base_link.
        front_lidar_yaw_rad: its heading.
        rear_lidar_x_m: rear LiDAR ahead of base_link.
        rear_lidar_yaw_rad: its heading.
    """

    start_x_m: float = number(4.0, -20.0, 20.0, "m")
    start_y_m: float = number(2.6, -20.0, 20.0, "m")
    start_heading_rad: float = number(math.atan2(-2.6, -4.0), -math.pi, math.pi, "rad")
    expected_length_m: float = number(4.5, 2.0, 10.0, "m")
    expected_width_m: float = number(1.8, 1.0, 3.0, "m")
    size_tolerance_m: float = number(0.8, 0.1, 3.0, "m")
    position_tolerance_m: float = number(1.2, 0.1, 3.0, "m")
    drift_limit_m: float = number(0.3, 0.02, 1.0, "m")
    prior_margin_m: float = number(0.5, 0.0, 2.0, "m")
    seen_margin_m: float = number(0.3, 0.0, 2.0, "m")
    ring_distance_m: float = number(1.6, 1.0, 5.0, "m")
    arrival_m: float = number(0.5, 0.05, 1.0, "m")
    look_first_s: float = number(1.0, 0.2, 10.0, "s")
    front_lidar_x_m: float = number(0.12, -1.0, 1.0, "m")
    front_lidar_yaw_rad: float = number(0.0, -math.pi, math.pi, "rad")
    rear_lidar_x_m: float = number(-0.20, -1.0, 1.0, "m")
    rear_lidar_yaw_rad: float = number(math.pi, -math.pi, math.pi, "rad")

    @property
    def car_from_start(self) -> Pose2:
        """Where the robot starts, in the Car's frame."""
        return Pose2(self.start_x_m, self.start_y_m, self.start_heading_rad)

    @property
    def base_from_front_lidar(self) -> Pose2:
        """Mounting of the front LiDAR."""
        return Pose2(self.front_lidar_x_m, 0.0, self.front_lidar_yaw_rad)

    @property
    def base_from_rear_lidar(self) -> Pose2:
        """Mounting of the rear LiDAR."""
        return Pose2(self.rear_lidar_x_m, 0.0, self.rear_lidar_yaw_rad)
