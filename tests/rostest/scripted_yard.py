"""A yard with a box as large as a car, and a robot that drives round it: wheels, gyro and LiDAR that agree."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
from nav_msgs.msg import Odometry
from scripted_sensors import GYRO_NOISE_RADPS, MILLIMETRE
from scripted_time import NS, STEP_NS, Speaker
from sensor_msgs.msg import Imu, LaserScan

from mtr_core import names, schedule
from mtr_core.se2 import Pose2

BEAMS = 360
FIELD_OF_VIEW_RAD = 1.5 * math.pi
GRAVITY_MPS2 = 9.81
CAR_M, YARD_M = (4.3, 1.8), (13.0, 11.0)
START = Pose2(0.0, -3.2, 0.0)
SWEEP_TICKS = schedule.LIDAR.period_ns // STEP_NS


def _rectangle(length, width):
    """Ends (4, 2, 2) of the sides."""
    corners = np.array([(x * length / 2.0, y * width / 2.0) for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))])
    return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)


SIDES = np.concatenate([_rectangle(*CAR_M), _rectangle(*YARD_M)])


def ranges_from(pose):
    """What a LiDAR at a pose in the yard measures."""
    angles = pose.heading + np.linspace(-0.5, 0.5, BEAMS) * FIELD_OF_VIEW_RAD
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, np.newaxis]
    begin, along = SIDES[:, 0] - (pose.x, pose.y), SIDES[:, 1] - SIDES[:, 0]
    with np.errstate(divide="ignore"):
        across = beams[..., 0] * along[:, 1] - beams[..., 1] * along[:, 0]
        distance = (begin[:, 0] * along[:, 1] - begin[:, 1] * along[:, 0]) / across
        share = (begin[:, 0] * beams[..., 1] - begin[:, 1] * beams[..., 0]) / across
    hit = (distance > 0.0) & (share >= 0.0) & (share <= 1.0)
    return np.where(hit, distance, np.inf).min(axis=1)


class YardRobot:
    """Stands or drives in the yard; its sensors speak at the ticks of a ScriptedTime.

    Attributes:
        pose: of base_link in the yard.
        speakers: of the sensors.
    """

    def __init__(self):
        self.pose = START
        self.wheels = Speaker(names.WHEEL_ODOMETRY, Odometry(), schedule.SENSORS)
        self.gyro = Speaker(names.IMU_DATA, Imu(), schedule.SENSORS)
        self.lidar = Speaker(names.FRONT_SCAN, LaserScan(), schedule.LIDAR)
        self.gyro.message.linear_acceleration.z = GRAVITY_MPS2
        scan = self.lidar.message
        scan.header.frame_id = names.FRONT_LIDAR
        scan.angle_min, scan.angle_max = -0.5 * FIELD_OF_VIEW_RAD, 0.5 * FIELD_OF_VIEW_RAD
        scan.angle_increment = FIELD_OF_VIEW_RAD / (BEAMS - 1)
        scan.scan_time, scan.range_min, scan.range_max = schedule.LIDAR.period_ns * NS, 0.1, 30.0
        self.speakers = [self.gyro, self.wheels, self.lidar]
        self._ticks = 0

    def drive(self, speed_mps, turn_radps):
        """One tick of motion, and what the sensors will say at its end."""
        duration_s = STEP_NS * NS
        half = 0.5 * turn_radps * duration_s
        self.pose = self.pose @ Pose2(speed_mps * duration_s * math.cos(half), speed_mps * duration_s * math.sin(half),
                                      2.0 * half)
        self._ticks += 1
        # What repeats itself to the last bit is taken for frozen.
        self.gyro.message.angular_velocity.z = turn_radps + (GYRO_NOISE_RADPS if self._ticks % 2 else -GYRO_NOISE_RADPS)
        wheels, moved = self.wheels.message, START.inverse() @ self.pose
        wheels.twist.twist.linear.x, wheels.twist.twist.angular.z = speed_mps, turn_radps
        wheels.pose.pose.position.x, wheels.pose.pose.position.y = moved.x, moved.y
        wheels.pose.pose.orientation.z = math.sin(0.5 * moved.heading)
        wheels.pose.pose.orientation.w = math.cos(0.5 * moved.heading)
        noise_m = MILLIMETRE if self._ticks // SWEEP_TICKS % 2 else -MILLIMETRE
        self.lidar.message.ranges = (ranges_from(self.pose) + noise_m).tolist()
