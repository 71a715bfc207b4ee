"""Wrong assemblies of a robot as changes of its sensor data, with the wording of the right verdict on each."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Callable, Dict, List, NamedTuple, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_motion_check.recording import ImuSample, Recording, ScanSample, WheelSample

Change = Callable[[Recording], Recording]


class Assembly(NamedTuple):
    """One assembly. causes: a part of each required sentence; no other sentence may report a fault."""

    change: Change
    causes: Tuple[str, ...]


def wheels(linear: float, angular: float) -> Change:
    """Return a change that scales the odometry's velocities."""
    return lambda recording: replace(recording, wheels=[
        WheelSample(each.time_s, linear * each.linear_mps, angular * each.angular_radps) for each in recording.wheels])


def imu(matrix: FloatArray, gyro_scale: float = 1.0) -> Change:
    """Return a change that rotates the IMU: imu_as_mounted_from_imu."""
    def turned(each: ImuSample) -> ImuSample:
        rates, force = matrix @ np.array(each.rate_radps) * gyro_scale, matrix @ np.array(each.force_mps2)
        return ImuSample(each.time_s, tuple(rates.tolist()), tuple(force.tolist()))
    return lambda recording: replace(recording, imu=[turned(each) for each in recording.imu])


def turned_scans(scans: List[ScanSample], matrix: FloatArray) -> List[ScanSample]:
    """Return the points of a LiDAR with another mounting: lidar_as_mounted_from_lidar."""
    return [ScanSample(each.time_s, each.points_m @ matrix.T) for each in scans]


def about_z(angle_deg: float) -> FloatArray:
    """Return a rotation of the plane."""
    cos, sin = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    return np.array([[cos, -sin], [sin, cos]])


def front(matrix: FloatArray) -> Change:
    """Return a change of the front LiDAR's mounting."""
    return lambda recording: replace(recording, front=turned_scans(recording.front, matrix))


def rear(matrix: FloatArray) -> Change:
    """Return a change of the rear LiDAR's mounting."""
    return lambda recording: replace(recording, rear=turned_scans(recording.rear, matrix))


RIGHT = "right"
MIRRORED = np.diag([1.0, -1.0])
UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])
ON_ITS_SIDE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
ON_ITS_NOSE = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
QUARTER_TURN = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
HALF_TURN = np.diag([-1.0, -1.0, 1.0])
WRONG_SIGN, RADIUS, IMU_TURNED = "odometry has the wrong sign", "correct the wheels' radius", "IMU is mounted turned"

ASSEMBLIES: Dict[str, Assembly] = {
    RIGHT: Assembly(lambda recording: recording, ()),
    "LiDARs swapped": Assembly(lambda recording: replace(recording, front=recording.rear, rear=recording.front),
                               ("LiDAR are swapped",)),
    "rear LiDAR on both topics": Assembly(lambda recording: replace(recording, front=recording.rear),
                                          ("front_lidar saw the robot go",)),
    "front LiDAR turned by 10 deg": Assembly(front(about_z(10.0)), ("front_lidar saw the robot go",)),
    "rear LiDAR turned by 180 deg": Assembly(rear(about_z(180.0)), ("rear_lidar saw the robot go",)),
    "front LiDAR upside down": Assembly(front(MIRRORED), ("front_lidar sees the robot turn",)),
    "rear LiDAR upside down": Assembly(rear(MIRRORED), ("rear_lidar sees the robot turn",)),
    "odometry reversed": Assembly(wheels(-1.0, -1.0), (WRONG_SIGN, WRONG_SIGN)),
    "odometry's way reversed": Assembly(wheels(-1.0, 1.0), (WRONG_SIGN,)),
    "odometry's turn reversed": Assembly(wheels(1.0, -1.0), ("left and right wheels are exchanged",)),
    "odometry 10 % short": Assembly(wheels(0.9, 0.9), (RADIUS,)),
    "odometry 10 % long": Assembly(wheels(1.1, 1.1), (RADIUS,)),
    "odometry twice as long": Assembly(wheels(2.0, 1.0), (RADIUS,)),
    "gyro 10 % too fast": Assembly(imu(np.eye(3), 1.1), ("its scale is wrong",)),
    "gyro in degrees": Assembly(imu(np.eye(3), 57.3), ("its scale is wrong",)),
    "IMU upside down": Assembly(imu(UPSIDE_DOWN), (IMU_TURNED, "mounted upside down")),
    "IMU on its side": Assembly(imu(ON_ITS_SIDE), (IMU_TURNED, "IMU is mounted turned or")),
    "IMU on its nose": Assembly(imu(ON_ITS_NOSE), (IMU_TURNED, "IMU is mounted turned or")),
    "IMU a quarter turn about z": Assembly(imu(QUARTER_TURN), ("turned about its vertical axis",)),
    "IMU half a turn about z": Assembly(imu(HALF_TURN), ("turned about its vertical axis",)),
}
