"""Direction and distance of the robot's motion as seen by each LiDAR while the wheels report forward motion."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, List, NamedTuple, Optional

from mtr_core import names
from mtr_core.se2 import Pose2, wrap_angle

from .fits import ratio
from .steps import Step

# A step with less rotation counts as straight: base_link moves in its own direction, within 3 degrees.
MAX_STRAIGHT_RAD = 0.1
# Minimum distance for the comparison of the sensors.
MIN_DISTANCE_M = 0.6
Sensor = Callable[[Step], Optional[Pose2]]


class Direction(NamedTuple):
    """Motion by a LiDAR for each metre that the wheels report.

    Attributes:
        scale: its length; 1 if both agree.
        scale_sigma: standard error of it.
        angle_rad: its direction in base_link; 0 if both agree.
        angle_sigma_rad: standard error of it.
    """

    scale: float
    scale_sigma: float
    angle_rad: float
    angle_sigma_rad: float

    def points_to(self, angle_rad: float, tolerance_rad: float) -> bool:
        """Return True for this direction, within the tolerance and two standard errors."""
        return abs(wrap_angle(self.angle_rad - angle_rad)) <= tolerance_rad + 2.0 * self.angle_sigma_rad


def front_of(step: Step) -> Optional[Pose2]:
    """Return base_from_base of a step by the front LiDAR."""
    return step.front


def rear_of(step: Step) -> Optional[Pose2]:
    """Return base_from_base of a step by the rear LiDAR."""
    return step.rear


class Lidar(NamedTuple):
    """One LiDAR: topic, frame and observed motion."""

    topic: str
    frame: str
    sensor: Sensor


FRONT = Lidar(names.FRONT_SCAN, names.FRONT_LIDAR, front_of)
REAR = Lidar(names.REAR_SCAN, names.REAR_LIDAR, rear_of)


def straight(steps: List[Step], sensor: Sensor) -> List[Step]:
    """Return the steps without rotation that the LiDAR observed."""
    return [step for step in steps for pose in (sensor(step),) if pose and abs(pose.heading) < MAX_STRAIGHT_RAD]


def distance_m(steps: List[Step], sensor: Sensor) -> float:
    """Return the distance by the LiDAR in straight steps, back and forth."""
    return sum(math.hypot(pose.x, pose.y) for pose in map(sensor, straight(steps, sensor)) if pose)


def wheels_distance_m(steps: List[Step], sensor: Sensor) -> float:
    """Return the distance by the wheels in the same steps."""
    return sum(abs(step.wheels.x) for step in straight(steps, sensor))


def direction(steps: List[Step], sensor: Sensor) -> Optional[Direction]:
    """Return the LiDAR's motion relative to the wheels'; None with too few steps."""
    used = straight(steps, sensor)
    wheels = [step.wheels.x for step in used]
    along = ratio(wheels, [pose.x for pose in map(sensor, used) if pose])
    across = ratio(wheels, [pose.y for pose in map(sensor, used) if pose])
    if along is None or across is None:
        return None
    scale = math.hypot(along.value, across.value)
    sigma = math.hypot(along.sigma, across.sigma)
    return Direction(scale, sigma, math.atan2(across.value, along.value), min(math.pi, sigma / max(scale, 1e-9)))
