"""Reads the robot's motion from the sensors of a bag with our topics, for the preflight and the calibration."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Iterator, Sequence, Tuple

import numpy as np
import rosbag

from mtr_core import names

from .recording import ImuSample, Recording, Sweep, WheelSample, scan_sample

SCANS = (names.FRONT_SCAN, names.REAR_SCAN)


def motion_in(bag: pathlib.Path, senses: Sequence[float]) -> Recording:
    """Return the motion of the whole bag. senses: see sweeps_in."""
    recording = Recording()
    with rosbag.Bag(str(bag)) as read:
        for topic, message, _ in read.read_messages(topics=[names.WHEEL_ODOMETRY, names.IMU_DATA]):
            stamp_s = message.header.stamp.to_sec()
            if topic == names.WHEEL_ODOMETRY:
                twist = message.twist.twist
                recording.wheels.append(WheelSample(stamp_s, twist.linear.x, twist.angular.z))
            else:
                rate, force = message.angular_velocity, message.linear_acceleration
                recording.imu.append(ImuSample(stamp_s, (rate.x, rate.y, rate.z), (force.x, force.y, force.z)))
    scans = (recording.front, recording.rear)
    for lidar, sweep in sweeps_in(bag, senses):
        scans[lidar].append(scan_sample(sweep))
    return recording


def sweeps_in(bag: pathlib.Path, senses: Sequence[float]) -> Iterator[Tuple[int, Sweep]]:
    """Yield each sweep with the number of its LiDAR, 0 for the front one. senses: of each LiDAR, -1 if it is mounted
    upside down; its sweeps are mirrored, because the evaluation assumes upright ones."""
    wanted = list(SCANS[:len(senses)])
    with rosbag.Bag(str(bag)) as read:
        # An empty list of topics would read all of them.
        for topic, message, _ in read.read_messages(topics=wanted) if wanted else ():
            lidar = SCANS.index(topic)
            yield lidar, Sweep(message.header.stamp.to_sec(), senses[lidar] * message.angle_min,
                               senses[lidar] * message.angle_increment, message.time_increment, message.range_min,
                               message.range_max, np.array(message.ranges))
