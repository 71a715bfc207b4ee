"""Converts readings of the simulated sensors to ROS messages; a message is sent immediately, so one object is
reused."""
# SPDX-License-Identifier: Apache-2.0
import io
import math
from typing import List, Sequence

import numpy as np
from genpy import Message
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from rospy import Time
from rospy.msg import serialize_message
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import BatteryState, Imu, LaserScan

from mtr_core import names
from mtr_core.crc import seal
from mtr_msgs.msg import FirmwareInputs, FirmwareState

from .firmware.signals import InputState
from .firmware.simulated import State
from .sensors.battery import CAPACITY_WH, FULL_V
from .sensors.imu import ImuParameters
from .sensors.readings import ODOMETRY_VARIANCES, BatteryReading, ImuReading, Scan, WheelOdometry
from .sim import TICK_S
from .true_state import TrueState

# Ranges remain a numpy array: 720 floats are copied as bytes.
NumpyScan = numpy_msg(LaserScan)
NO_INTENSITIES = np.zeros(0, dtype=np.float32)


def stamp(time_ns: int) -> Time:
    """Return nanoseconds as a ROS time."""
    return Time(time_ns // 1_000_000_000, time_ns % 1_000_000_000)


def serialized(message: Message) -> bytes:
    """Return the serialized message as sent over a connection."""
    buffer = io.BytesIO()
    serialize_message(buffer, 0, message)
    return buffer.getvalue()


def clock_message(time_ns: int) -> Clock:
    """Return the message of the simulated time."""
    return Clock(stamp(time_ns))


def scan_message(scan: Scan, frame: str) -> LaserScan:
    """Return the message of one sweep."""
    message = NumpyScan()
    message.header.stamp, message.header.frame_id = stamp(scan.stamp_ns), frame
    message.angle_min, message.angle_increment = scan.angle_min_rad, scan.angle_increment_rad
    message.angle_max = scan.angle_min_rad + scan.angle_increment_rad * (len(scan.ranges_m) - 1)
    message.time_increment, message.scan_time = scan.time_increment_s, scan.scan_time_s
    message.range_min, message.range_max = scan.range_min_m, scan.range_max_m
    message.ranges, message.intensities = scan.ranges_m, NO_INTENSITIES
    return message


class ImuMessage:
    """Fills an Imu message; the sensor has no orientation."""

    def __init__(self, parameters: ImuParameters):
        self._message = Imu()
        self._message.header.frame_id = names.IMU
        self._message.orientation_covariance[0] = -1.0
        self._message.angular_velocity_covariance = _diagonal([parameters.gyro_density**2 / TICK_S] * 3)
        self._message.linear_acceleration_covariance = _diagonal([parameters.accelerometer_density**2 / TICK_S] * 3)

    def fill(self, time_ns: int, reading: ImuReading) -> Imu:
        """Return the message of a reading."""
        message = self._message
        message.header.stamp = stamp(time_ns)
        rate, force = message.angular_velocity, message.linear_acceleration
        rate.x, rate.y, rate.z = reading.angular_velocity
        force.x, force.y, force.z = reading.acceleration
        return message


class OdometryMessage:
    """Fills an Odometry message."""

    def __init__(self, frame: str, variances: Sequence[float] = ODOMETRY_VARIANCES):
        self._message = Odometry()
        self._message.header.frame_id, self._message.child_frame_id = frame, names.BASE
        self._message.pose.covariance = self._message.twist.covariance = _diagonal(variances)

    def fill(self, time_ns: int, reading: WheelOdometry, lateral_mps: float = 0.0) -> Odometry:
        """Return the message of a reading."""
        message = self._message
        message.header.stamp = stamp(time_ns)
        position, twist = message.pose.pose.position, message.twist.twist
        position.x, position.y = reading.x_m, reading.y_m
        message.pose.pose.orientation = yaw_quaternion(reading.heading_rad)
        twist.linear.x, twist.linear.y, twist.angular.z = reading.linear_mps, lateral_mps, reading.angular_radps
        return message


class TruthMessage:
    """Fills the message of the true pose of base_link in the true Car's frame."""

    def __init__(self) -> None:
        self._odometry = OdometryMessage(names.CAR, (0.0,) * 6)

    def fill(self, truth: TrueState, offset_ns: int = 0) -> Odometry:
        """Return the message of the true state; offset_ns is added to its stamp."""
        pose = truth.car_from_base
        reading = WheelOdometry(pose.x, pose.y, pose.heading, truth.linear_mps, truth.angular_radps)
        return self._odometry.fill(truth.time_ns + offset_ns, reading, truth.lateral_mps)


def battery_message(time_ns: int, reading: BatteryReading) -> BatteryState:
    """Return the message of the state of charge."""
    message = BatteryState(voltage=reading.voltage_v, current=reading.current_a, percentage=reading.charge,
                           design_capacity=CAPACITY_WH / FULL_V, charge=math.nan, capacity=math.nan, present=True,
                           power_supply_status=BatteryState.POWER_SUPPLY_STATUS_DISCHARGING)
    message.header.stamp, message.header.frame_id = stamp(time_ns), names.BASE
    return message


def firmware_message(state: State) -> FirmwareState:
    """Return the message of the firmware's state."""
    return seal(FirmwareState(*state, 0))


def inputs_message(state: InputState) -> FirmwareInputs:
    """Return the message of the firmware's inputs and signals."""
    return seal(FirmwareInputs(*state, 0))


def _diagonal(values: Sequence[float]) -> List[float]:
    diagonal: List[float] = np.diag(values).reshape(-1).tolist()
    return diagonal


def yaw_quaternion(heading_rad: float) -> Quaternion:
    return Quaternion(0.0, 0.0, math.sin(heading_rad / 2.0), math.cos(heading_rad / 2.0))
