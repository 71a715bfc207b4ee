"""Poses on the robot as plain values in base_link (REP-103); m and rad."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple

from mtr_core.errors import ConfigurationError, range_problem
from mtr_core.se2 import Pose2

# Largest tilt of a LiDAR mount; with more, it would see ground and sky: 2 degrees are 0.35 m at 10 m.
MAX_TILT_RAD = math.radians(2.0)


@dataclass(frozen=True)
class Mount:
    """base_from_frame of a frame that does not move on the robot; roll, pitch and yaw about fixed axes x, y, z.

    Attributes:
        frame: name of the frame.
    """

    frame: str
    x_m: float
    y_m: float
    z_m: float
    roll_rad: float
    pitch_rad: float
    yaw_rad: float

    @property
    def position(self) -> Tuple[float, float, float]:
        """Origin of the frame in base_link, in m."""
        return self.x_m, self.y_m, self.z_m

    def level(self) -> Pose2:
        """Return base_from_frame seen from above; ConfigurationError unless the frame is upright and level."""
        check_value(f"The roll of {self.frame}", self.roll_rad, -MAX_TILT_RAD, MAX_TILT_RAD, "rad")
        check_value(f"The pitch of {self.frame}", self.pitch_rad, -MAX_TILT_RAD, MAX_TILT_RAD, "rad")
        return Pose2(self.x_m, self.y_m, self.yaw_rad)


class LidarMounts(NamedTuple):
    """base_from_lidar of the LiDARs, seen from above; both are upright and level. The rear LiDAR is optional."""

    front: Pose2
    rear: Optional[Pose2]


@dataclass(frozen=True)
class Footprint:
    """The robot from above, including its key, for any height of the lift.

    Attributes:
        corners: of the convex hull in base_link, counterclockwise, in m.
    """

    corners: Tuple[Tuple[float, float], ...]

    @property
    def front_m(self) -> float:
        """Distance from base_link to the foremost point."""
        return max(x for x, _ in self.corners)

    @property
    def rear_m(self) -> float:
        """Distance from base_link to the rearmost point; positive."""
        return -min(x for x, _ in self.corners)

    @property
    def half_width_m(self) -> float:
        """Largest distance from the middle line on either side."""
        return max(abs(y) for _, y in self.corners)

    def radius_m(self, x_m: float = 0.0) -> float:
        """Return the radius of the circle that is swept by a turn on the spot about (x, 0)."""
        return max(math.hypot(x - x_m, y) for x, y in self.corners)


@dataclass(frozen=True)
class KeyMount:
    """The remote key on its lift.

    Attributes:
        x_m, y_m: lever of the key in base_link.
        min_height_m: above ground with the lift at its lower stop.
        lift_travel_m: travel of the lift from there.
    """

    x_m: float
    y_m: float
    min_height_m: float
    lift_travel_m: float

    @property
    def max_height_m(self) -> float:
        """Height above ground with the lift at its upper stop."""
        return round(self.min_height_m + self.lift_travel_m, 9)


@dataclass(frozen=True)
class Wheels:
    """The four wheels.

    Attributes:
        base_m: distance between the axles.
        track_m: distance between the middles of the left and the right wheels.
        radius_m: of each wheel.
        axle_z_m: height of the axles in base_link.
    """

    base_m: float
    track_m: float
    radius_m: float
    axle_z_m: float


def check_value(subject: str, value: float, low: float, high: float, unit: str) -> None:
    """Raise ConfigurationError with the subject, its value and the allowed range, unless the value is in range."""
    problem = range_problem(f"{subject} in robot_description", value, low, high, unit)
    if problem:
        raise ConfigurationError(problem)
