"""Which way, and how far, each LiDAR saw the robot go where the wheels say it went forward."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, List, NamedTuple, Optional

from mtr_core import names
from mtr_core.se2 import Pose2, wrap_angle

from .fits import ratio
from .steps import Step

# A step that turns less is straight: base_link goes where it points, to 3 degrees.
MAX_STRAIGHT_RAD = 0.1
# What has to be driven before the sensors are compared.
MIN_DISTANCE_M = 0.6
Sensor = Callable[[Step], Optional[Pose2]]


class Direction(NamedTuple):
    """Motion by a LiDAR for each metre that the wheels say.

    Attributes:
        scale: its length; 1 when both agree.
        scale_sigma: standard error of it.
        angle_rad: its direction in base_link; 0 when both agree.
        angle_sigma_rad: standard error of it.
    """

    scale: float
    scale_sigma: float
    angle_rad: float
    angle_sigma_rad: float

    def points_to(self, angle_rad: float, tolerance_rad: float) -> bool:
        """The direction is this one, within the tolerance and two standard errors."""
        return abs(wrap_angle(self.angle_rad - angle_rad)) <= tolerance_rad + 2.0 * self.angle_sigma_rad


def front_of(step: Step) -> Optional[Pose2]:
    """base_from_base of a step by the front LiDAR."""
    return step.front


def rear_of(step: Step) -> Optional[Pose2]:
    """base_from_base of a step by the rear LiDAR."""
    return step.rear


class Lidar(NamedTuple):
    """One LiDAR: topic, frame and what it saw."""

    topic: str
    frame: str
    sensor: Sensor


FRONT = Lidar(names.FRONT_SCAN, names.FRONT_LIDAR, front_of)
REAR = Lidar(names.REAR_SCAN, names.REAR_LIDAR, rear_of)


def straight(steps: List[Step], sensor: Sensor) -> List[Step]:
    """Steps without turn of which the LiDAR tells."""
    return [step for step in steps for pose in (sensor(step),) if pose and abs(pose.heading) < MAX_STRAIGHT_RAD]


def distance_m(steps: List[Step], sensor: Sensor) -> float:
    """Way by the LiDAR in straight steps, there and back."""
    return sum(math.hypot(pose.x, pose.y) for pose in map(sensor, straight(steps, sensor)) if pose)


def wheels_distance_m(steps: List[Step], sensor: Sensor) -> float:
    """The same by the wheels."""
    return sum(abs(step.wheels.x) for step in straight(steps, sensor))


def direction(steps: List[Step], sensor: Sensor) -> Optional[Direction]:
    """What a LiDAR says of the wheels' way; None with too few steps."""
    used = straight(steps, sensor)
    wheels = [step.wheels.x for step in used]
    along = ratio(wheels, [pose.x for pose in map(sensor, used) if pose])
    across = ratio(wheels, [pose.y for pose in map(sensor, used) if pose])
    if along is None or across is None:
        return None
    scale = math.hypot(along.value, across.value)
    sigma = math.hypot(along.sigma, across.sigma)
    return Direction(scale, sigma, math.atan2(across.value, along.value), min(math.pi, sigma / max(scale, 1e-9)))
