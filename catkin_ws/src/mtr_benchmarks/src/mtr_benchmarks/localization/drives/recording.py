"""Writes one drive: a bag with the inputs of the robot's nodes, and the truth in separate files."""
# SPDX-License-Identifier: Apache-2.0
import csv
import json
import pathlib
from dataclasses import replace
from types import TracebackType
from typing import Any, Dict, Optional, Type

import rosbag
from geometry_msgs.msg import Transform, TransformStamped
from tf2_msgs.msg import TFMessage

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_description.shipped import shipped_geometry
from mtr_msgs.msg import MappingOrder
from mtr_simulation import conversions
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.readings import Sensors
from mtr_simulation.true_state import TrueState

KEY = shipped_geometry().key()
BAG, TRUTH, META = "drive.bag", "truth.csv", "meta.json"
TRUTH_COLUMNS = ("stamp_s", "car_x_m", "car_y_m", "car_heading_rad", "world_x_m", "world_y_m", "world_heading_rad",
                 "key_x_m", "key_y_m", "linear_mps", "angular_radps", "tilt_rad", "standing", "segment")
# Below these speeds the robot counts as stopped.
STANDING_MPS, STANDING_RADPS = 0.002, 0.002


class Recording:
    """Files of one drive in a folder; use as a context manager."""

    def __init__(self, folder: pathlib.Path, lidar_height_m: float):
        self._folder, self._lidar_height_m = folder, lidar_height_m
        self._imu = conversions.ImuMessage(ImuParameters())
        self._odometry = conversions.OdometryMessage(names.ODOM)
        self._bag: Any = None
        self._truth: Any = None
        self._rows: Any = None

    def __enter__(self) -> "Recording":
        self._folder.mkdir(parents=True, exist_ok=True)
        self._bag = rosbag.Bag(str(self._folder / BAG), "w")
        self._truth = (self._folder / TRUTH).open("w", newline="", encoding="utf-8")
        self._rows = csv.writer(self._truth)
        self._rows.writerow(TRUTH_COLUMNS)
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self._bag.close()
        self._truth.close()

    def mounts(self, time_ns: int) -> None:
        """Write the poses of LiDARs and IMU, as robot_state_publisher publishes them."""
        geometry = shipped_geometry()
        mounts = [replace(geometry.mount(frame), z_m=self._lidar_height_m - geometry.base_height_m())
                  for frame in (names.FRONT_LIDAR, names.REAR_LIDAR)]
        transforms = []
        for mount in (*mounts, geometry.mount(names.IMU)):
            each = TransformStamped(child_frame_id=mount.frame, transform=Transform())
            each.header.frame_id, each.header.stamp = names.BASE, conversions.stamp(time_ns)
            each.transform.translation.x, each.transform.translation.z = mount.x_m, mount.z_m
            each.transform.rotation = conversions.yaw_quaternion(mount.yaw_rad)
            transforms.append(each)
        self._write("/tf_static", TFMessage(transforms), time_ns)

    def sensors(self, sensors: Sensors) -> None:
        """Write all new readings of one tick."""
        time_ns = sensors.time_ns
        for topic, scan, frame in ((names.FRONT_SCAN, sensors.front_scan, names.FRONT_LIDAR),
                                   (names.REAR_SCAN, sensors.rear_scan, names.REAR_LIDAR)):
            if scan:
                self._write(topic, conversions.scan_message(scan, frame), time_ns)
        self._write(names.IMU_DATA, self._imu.fill(time_ns, sensors.imu), time_ns)
        self._write(names.WHEEL_ODOMETRY, self._odometry.fill(time_ns, sensors.odometry), time_ns)

    def mapping(self, time_ns: int, map_car_id: int, phase: int) -> None:
        """Write the Car locator's request to localization."""
        message = MappingOrder(map_car_id=map_car_id, phase=phase)
        message.header.stamp = conversions.stamp(time_ns)
        self._write(names.MAPPING_ORDER, message, time_ns)

    def truth(self, truth: TrueState, segment: int) -> None:
        """Write the robot's true state; the key's position assumes a level robot."""
        car, world = truth.car_from_base, truth.world_from_base
        key_x, key_y = car.apply(KEY.x_m, 0.0)
        standing = abs(truth.linear_mps) < STANDING_MPS and abs(truth.angular_radps) < STANDING_RADPS
        self._rows.writerow([f"{truth.time_ns * 1e-9:.3f}", *(f"{value:.6f}" for value in (
            car.x, car.y, car.heading, world.x, world.y, world.heading, key_x, key_y, truth.linear_mps,
            truth.angular_radps, truth.tilt_rad)), int(standing), segment])

    def meta(self, values: Dict[str, Any]) -> None:
        """Write the description of the drive."""
        (self._folder / META).write_text(json.dumps(values, indent=2) + "\n", encoding="utf-8")

    def _write(self, topic: str, message: Any, time_ns: int) -> None:
        self._bag.write(topic, message, conversions.stamp(time_ns))


def pose_values(pose: Pose2) -> Dict[str, float]:
    """Return a pose for meta.json."""
    return {"x_m": pose.x, "y_m": pose.y, "heading_rad": pose.heading}
