"""State of the running robot while a person moves it: pose, distance of the wheels, rotation of the gyro, key
height."""
# SPDX-License-Identifier: Apache-2.0
import math
import threading
import time
from typing import Any, List, Optional

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_description.mounts import KeyMount
from mtr_description.robot_description import described_robot
from mtr_description.robot_geometry import RobotGeometry
from mtr_msgs.msg import LocalizedPose, PeripheralsState

from .odometer import GyroTurn, mean_pose, way_between
from .readings import ReadingsUnusable

# Averaging time for the poses of a stationary robot.
STANDING_S = 1.0
SILENT_AFTER_S = 1.0


class Robot:
    """Subscriber to the robot's topics from its construction on; it publishes nothing."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._poses: List[Pose2] = []
        self._wants_poses = False
        self._moved = False
        self._odometry: Optional[Pose2] = None
        self._start: Optional[Pose2] = None
        self._height_m, self._height_s = math.nan, -math.inf
        self._gyro = GyroTurn()
        rospy.Subscriber(names.LOCALIZED_POSE, LocalizedPose, self._take_pose)
        rospy.Subscriber(names.WHEEL_ODOMETRY, Odometry, self._take_odometry)
        rospy.Subscriber(names.IMU_DATA, Imu, self._take_imu)
        rospy.Subscriber(names.PERIPHERALS_STATE, PeripheralsState, self._take_peripherals)

    def key(self) -> KeyMount:
        """Return the key as described in the robot's URDF."""
        return described_robot().key()

    def geometry(self) -> RobotGeometry:
        """Return the robot as described in its URDF."""
        return described_robot()

    def pose(self) -> Pose2:
        """Return the mean pose in map over a second; ReadingsUnusable if the robot moves or is not localized."""
        with self._lock:
            self._poses, self._moved, self._wants_poses = [], False, True
        time.sleep(STANDING_S)
        with self._lock:
            self._wants_poses = False
            poses, moved = list(self._poses), self._moved
        if moved:
            raise ReadingsUnusable("The robot moved while it was looked at; let it stand, and try again.")
        if not poses:
            raise ReadingsUnusable("The robot does not know where it is; map something, for example the Car, and begin "
                                   "again.")
        return mean_pose(poses)

    def begin(self) -> None:
        """Start counting distance and rotation."""
        with self._lock:
            self._start = self._odometry
            self._gyro.begin()

    def way_m(self) -> float:
        """Distance of the wheels since begin(), in a straight line, negative backwards; ReadingsUnusable while
        silent."""
        with self._lock:
            if self._start is None or self._odometry is None:
                raise ReadingsUnusable(f"Nothing is heard on {names.WHEEL_ODOMETRY}; start the base, and try again.")
            return way_between(self._start, self._odometry)

    def turn_rad(self) -> float:
        """Rotation of the gyro since begin(), less its offset at rest, positive to the left."""
        with self._lock:
            return self._gyro.turn_rad()

    def key_height_m(self) -> float:
        """Return the key's height above ground; ReadingsUnusable while the board is silent."""
        with self._lock:
            if time.monotonic() - self._height_s > SILENT_AFTER_S or math.isnan(self._height_m):
                raise ReadingsUnusable(f"No height is heard on {names.PERIPHERALS_STATE}; look at the board of the "
                                       "lift, and begin again.")
            return self._height_m

    def _take_pose(self, message: Any) -> None:
        with self._lock:
            if self._wants_poses and message.valid:
                self._poses.append(Pose2(message.x, message.y, message.heading))
                self._moved |= abs(message.speed_mps) > 0.01 or abs(message.yaw_rate_radps) > 0.02

    def _take_odometry(self, message: Any) -> None:
        pose = message.pose.pose
        with self._lock:
            self._odometry = Pose2(pose.position.x, pose.position.y,
                                   2.0 * math.atan2(pose.orientation.z, pose.orientation.w))

    def _take_imu(self, message: Any) -> None:
        with self._lock:
            self._gyro.add(message.header.stamp.to_sec(), message.angular_velocity.z)

    def _take_peripherals(self, message: Any) -> None:
        with self._lock:
            if message.alive:
                self._height_m, self._height_s = message.key_height_m, time.monotonic()
