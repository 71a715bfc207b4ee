"""LiDARs and the planned path for the Operator's picture: stored as bytes, and parsed only when a Status needs them."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, Optional

import numpy as np
import rospy
from genpy import DeserializationError
from nav_msgs.msg import Path
from sensor_msgs.msg import LaserScan

from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_description.mounts import LidarMounts
from mtr_description.robot_geometry import RobotGeometry

from .status.inputs import STALE_AFTER_S, Inputs
from .status.surroundings import Motion, Obstacle, Surroundings, Sweep, path_of, points_of

# Every second Status has a picture, which is five times a second.
_EVERY = 2


def mounted_lidars(robot: RobotGeometry) -> LidarMounts:
    """Return the mounts of the LiDARs in the robot's description."""
    try:
        return robot.lidars()
    except ConfigurationError:
        return robot.lidars(has_rear=False)


class Eyes:
    """Newest messages for the picture. They are not synchronised in lock-step, because no decision depends on them."""

    def __init__(self, lidars: LidarMounts):
        self._mounts = {names.FRONT_SCAN: lidars.front}
        if lidars.rear is not None:
            self._mounts[names.REAR_SCAN] = lidars.rear
        self._newest: Dict[str, Any] = {}
        self._count = 0
        self._subscribers = [self._subscriber(topic) for topic in (*self._mounts, names.MOTION_PATH)]

    def _subscriber(self, topic: str) -> rospy.Subscriber:
        # Messages arrive 50 times a second and are used five times a second: the others are not deserialized.
        return rospy.Subscriber(topic, rospy.AnyMsg, lambda message: self._newest.update({topic: message}),
                                queue_size=1)

    def look(self, inputs: Inputs) -> Optional[Surroundings]:
        """Return the surroundings; None in Statuses without a picture, and while the robot has no pose."""
        self._count += 1
        pose = inputs.pose
        if self._count % _EVERY or pose is None:
            return None
        motion = Motion(pose.header.stamp.to_sec(), pose.speed_mps, pose.yaw_rate_radps)
        drive = inputs.drive
        obstacle = None if drive is None else Obstacle(drive.zone, drive.obstacle_m, drive.obstacle_bearing)
        return Surroundings(points_of(self._sweeps(motion), motion), self._path(inputs), obstacle)

    def _sweeps(self, motion: Motion) -> List[Sweep]:
        scans = ((self._read(topic, LaserScan()), mount) for topic, mount in self._mounts.items())
        return [_sweep(scan, mount) for scan, mount in scans
                if scan is not None and abs(scan.header.stamp.to_sec() - motion.stamp_s) < STALE_AFTER_S]

    def _path(self, inputs: Inputs) -> FloatArray:
        car = inputs.car
        path = self._read(names.MOTION_PATH, Path())
        if path is None or car is None or car.state != CarState.LOCATED or not path.poses:
            return np.empty((0, 2))
        places = np.array([(each.pose.position.x, each.pose.position.y) for each in path.poses], dtype=float)
        # The planner plans around a located Car in the Car's frame.
        is_cars = path.header.frame_id == names.CAR
        return path_of(places, Pose2(0.0, 0.0, 0.0) if is_cars else Pose2(car.x, car.y, car.heading).inverse())

    def _read(self, topic: str, empty: Any) -> Any:
        """Return the newest message of a topic; None before the first one, and if it has another type."""
        raw = self._newest.get(topic)
        try:
            # AnyMsg has no public access to its bytes.
            return None if raw is None else empty.deserialize(raw._buff)
        except DeserializationError:  # Another program publishes another type on the topic; the link must continue.
            return None


def _sweep(scan: LaserScan, mount: Pose2) -> Sweep:
    return Sweep(scan.header.stamp.to_sec(), scan.ranges, scan.angle_min, scan.angle_increment, scan.range_min,
                 scan.range_max, mount)
