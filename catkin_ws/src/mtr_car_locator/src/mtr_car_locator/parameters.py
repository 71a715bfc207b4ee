"""Parameters of the car locator."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
from dataclasses import dataclass

from mtr_core.errors import check_range
from mtr_core.se2 import Pose2


def _parameter(default: float, low: float, high: float, unit: str) -> float:
    return dataclasses.field(default=default, metadata={"low": low, "high": high, "unit": unit})


@dataclass(frozen=True)
class LocatorParameters:
    """Checked once, when it is made; ConfigurationError names a parameter out of range.

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

    start_x_m: float = _parameter(4.0, -20.0, 20.0, "m")
    start_y_m: float = _parameter(2.6, -20.0, 20.0, "m")
    start_heading_rad: float = _parameter(math.atan2(-2.6, -4.0), -math.pi, math.pi, "rad")
    expected_length_m: float = _parameter(4.5, 2.0, 10.0, "m")
    expected_width_m: float = _parameter(1.8, 1.0, 3.0, "m")
    size_tolerance_m: float = _parameter(0.8, 0.1, 3.0, "m")
    position_tolerance_m: float = _parameter(1.2, 0.1, 3.0, "m")
    drift_limit_m: float = _parameter(0.3, 0.02, 1.0, "m")
    prior_margin_m: float = _parameter(0.5, 0.0, 2.0, "m")
    seen_margin_m: float = _parameter(0.3, 0.0, 2.0, "m")
    ring_distance_m: float = _parameter(1.6, 1.0, 5.0, "m")
    arrival_m: float = _parameter(0.5, 0.05, 1.0, "m")
    look_first_s: float = _parameter(1.0, 0.2, 10.0, "s")
    front_lidar_x_m: float = _parameter(0.12, -1.0, 1.0, "m")
    front_lidar_yaw_rad: float = _parameter(0.0, -math.pi, math.pi, "rad")
    rear_lidar_x_m: float = _parameter(-0.20, -1.0, 1.0, "m")
    rear_lidar_yaw_rad: float = _parameter(math.pi, -math.pi, math.pi, "rad")

    def __post_init__(self) -> None:
        for item in dataclasses.fields(self):
            limits = item.metadata
            check_range(item.name, getattr(self, item.name), limits["low"], limits["high"], limits["unit"])

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
