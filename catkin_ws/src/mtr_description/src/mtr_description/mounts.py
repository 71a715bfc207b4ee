"""Where things are on the robot, as plain values in base_link (REP-103); m and rad."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple

from mtr_core.errors import ConfigurationError, range_problem
from mtr_core.se2 import Pose2

# A LiDAR whose mount is turned further sees ground and sky instead of what is around it: 2 degrees are 0.35 m at 10 m.
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
        """base_from_frame seen from above; ConfigurationError unless the frame is upright and level."""
        check_value(f"The roll of {self.frame}", self.roll_rad, -MAX_TILT_RAD, MAX_TILT_RAD, "rad")
        check_value(f"The pitch of {self.frame}", self.pitch_rad, -MAX_TILT_RAD, MAX_TILT_RAD, "rad")
        return Pose2(self.x_m, self.y_m, self.yaw_rad)


class LidarMounts(NamedTuple):
    """base_from_lidar of the LiDARs, seen from above; both are upright and level. A robot may have no rear one."""

    front: Pose2
    rear: Optional[Pose2]


@dataclass(frozen=True)
class Footprint:
    """The robot from above, its key included, whatever the lift's height.

    Attributes:
        corners: of the convex hull in base_link, counterclockwise, in m.
    """

    corners: Tuple[Tuple[float, float], ...]

    @property
    def front_m(self) -> float:
        """From base_link to what is foremost."""
        return max(x for x, _ in self.corners)

    @property
    def rear_m(self) -> float:
        """From base_link to what is rearmost; positive."""
        return -min(x for x, _ in self.corners)

    @property
    def half_width_m(self) -> float:
        """From the middle line to what is farthest from it, on either side."""
        return max(abs(y) for _, y in self.corners)

    def radius_m(self, x_m: float = 0.0) -> float:
        """Of the circle about (x, 0) that a turn on the spot about that point sweeps."""
        return max(math.hypot(x - x_m, y) for x, y in self.corners)


@dataclass(frozen=True)
class KeyMount:
    """The remote key on its lift.

    Attributes:
        x_m, y_m: lever of the key in base_link.
        min_height_m: above ground with the lift at its lower stop.
        lift_travel_m: how far the lift goes up from there.
    """

    x_m: float
    y_m: float
    min_height_m: float
    lift_travel_m: float

    @property
    def max_height_m(self) -> float:
        """Above ground with the lift at its upper stop."""
        return round(self.min_height_m + self.lift_travel_m, 9)


@dataclass(frozen=True)
class Wheels:
    """The four wheels.

    Attributes:
        base_m: between the axles.
        track_m: between the middles of the left and the right wheels.
        radius_m: of each.
        axle_z_m: of the axles in base_link.
    """

    base_m: float
    track_m: float
    radius_m: float
    axle_z_m: float


def check_value(subject: str, value: float, low: float, high: float, unit: str) -> None:
    """ConfigurationError that says the subject in robot_description, its value and what is allowed, unless in range."""
    problem = range_problem(f"{subject} in robot_description", value, low, high, unit)
    if problem:
        raise ConfigurationError(problem)
