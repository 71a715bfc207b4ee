"""Reads the sensor data of a recorded bag as arrays."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Any, List, Mapping, NamedTuple, Optional

import numpy as np
import rosbag

from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_description.shipped import shipped_geometry

MOUNTS = {topic: shipped_geometry().mount(frame).level()
          for topic, frame in ((names.FRONT_SCAN, names.FRONT_LIDAR), (names.REAR_SCAN, names.REAR_LIDAR))}


class Sweep(NamedTuple):
    """One scan: stamps of its beams in s, their angles in base_link, x position of the LiDAR, and ranges."""

    stamps_s: FloatArray
    angles_rad: FloatArray
    x_m: float
    ranges_m: FloatArray


class SensorLog(NamedTuple):
    """Sensor data of one drive: rows (stamp, speed) of the wheels, rows (stamp, yaw rate) of the gyro, sweeps by
    stamp."""

    wheels: FloatArray
    gyro: FloatArray
    sweeps: List[Sweep]


def read_sensors(bag: pathlib.Path, mounts: Optional[Mapping[str, Pose2]] = None) -> SensorLog:
    """Read wheels, gyro and scans. mounts: base_from_lidar of each topic with scans; None: this robot's mounts."""
    mounts = MOUNTS if mounts is None else mounts
    wheels, gyro, sweeps = [], [], []
    with rosbag.Bag(str(bag)) as file:
        for topic, message, _ in file.read_messages(topics=[names.WHEEL_ODOMETRY, names.IMU_DATA, *mounts]):
            stamp = message.header.stamp.to_sec()
            if topic == names.WHEEL_ODOMETRY:
                wheels.append((stamp, message.twist.twist.linear.x))
            elif topic == names.IMU_DATA:
                gyro.append((stamp, message.angular_velocity.z))
            else:
                sweeps.append(_sweep(message, stamp, mounts[topic].x, mounts[topic].heading))
    return SensorLog(np.array(wheels), np.array(gyro), sorted(sweeps, key=lambda sweep: float(sweep.stamps_s[0])))


def _sweep(message: Any, stamp_s: float, x_m: float, yaw_rad: float) -> Sweep:
    ranges = np.array(message.ranges, dtype=np.float32)
    beams = np.arange(len(ranges))
    usable = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    angles = np.mod(yaw_rad + message.angle_min + message.angle_increment * beams, 2.0 * math.pi)
    return Sweep(stamp_s + message.time_increment * beams, angles, x_m, np.where(usable, ranges, 0.0))
