"""Scripted sensors of a robot that stands on open ground with a low key."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from scripted_time import NS, Speaker
from sensor_msgs.msg import Imu, LaserScan

from mtr_core import names, schedule
from mtr_msgs.msg import PeripheralsState

BEAMS = 271
FIELD_OF_VIEW_RAD = 1.5 * math.pi
# Walls far away: without any echo a LiDAR counts as covered.
FAR_M = 20.0
MILLIMETRE = 0.001
GYRO_NOISE_RADPS = 0.001
GRAVITY_MPS2 = 9.81
TWO_SWEEPS_NS = 2 * schedule.LIDAR.period_ns


class LidarSpeaker(Speaker):
    """A LiDAR whose ranges change a little with every sweep, as a live one's do."""

    def speak(self, tick_ns: int) -> None:
        """Say the sweep if it is time."""
        self.message.ranges = [value + (MILLIMETRE if tick_ns % TWO_SWEEPS_NS else -MILLIMETRE)
                               for value in self.message.ranges]
        super().speak(tick_ns)


class WheelsSpeaker(Speaker):
    """Odometry of a base that obeys exactly: it does what the wheels were told last.

    Attributes:
        is_frozen: True while it repeats itself.
    """

    def __init__(self) -> None:
        odometry = Odometry()
        odometry.pose.pose.orientation.w = 1.0
        super().__init__(names.WHEEL_ODOMETRY, odometry, schedule.SENSORS)
        self._heading = 0.0
        self.is_frozen = False

    def obey(self, twist: Twist) -> None:
        """Take a command."""
        if not self.is_frozen:
            self.message.twist.twist = twist

    def speak(self, tick_ns: int) -> None:
        """Say the odometry if it is time."""
        if self.is_frozen:
            super().speak(tick_ns)
            return
        twist, pose = self.message.twist.twist, self.message.pose.pose
        pose.position.x += twist.linear.x * schedule.SENSORS.period_ns * NS * math.cos(self._heading)
        pose.position.y += twist.linear.x * schedule.SENSORS.period_ns * NS * math.sin(self._heading)
        self._heading += twist.angular.z * schedule.SENSORS.period_ns * NS
        pose.orientation.z, pose.orientation.w = math.sin(self._heading / 2.0), math.cos(self._heading / 2.0)
        super().speak(tick_ns)


class ImuSpeaker(Speaker):
    """An IMU on a base whose wheels do not slip.

    Like a live one it never says the same twice, unless it is frozen.

    Attributes:
        is_frozen: True while it repeats itself.
        pitch_rad: of the ground, downhill ahead.
    """

    def __init__(self, wheels: WheelsSpeaker) -> None:
        super().__init__(names.IMU_DATA, Imu(), schedule.SENSORS)
        self._wheels, self._speed_mps = wheels, 0.0
        self.is_frozen, self.pitch_rad = False, 0.0

    def speak(self, tick_ns: int) -> None:
        """Say the reading if it is time."""
        if not self.is_frozen:
            noise = GYRO_NOISE_RADPS if tick_ns % TWO_SWEEPS_NS else -GYRO_NOISE_RADPS
            self.message.angular_velocity.x = noise
            moved = self._wheels.message.twist.twist
            self.message.angular_velocity.z = moved.angular.z + noise
            acceleration = (moved.linear.x - self._speed_mps) / (schedule.SENSORS.period_ns * NS)
            self._speed_mps = moved.linear.x
            self.message.linear_acceleration = Vector3(
                acceleration - GRAVITY_MPS2 * math.sin(self.pitch_rad), moved.linear.x * moved.angular.z,
                GRAVITY_MPS2 * math.cos(self.pitch_rad))
        super().speak(tick_ns)


def open_ground() -> Tuple[Speaker, Speaker, WheelsSpeaker, ImuSpeaker, Speaker]:
    """Speakers of front LiDAR, rear LiDAR, odometry, IMU and peripherals."""
    wheels = WheelsSpeaker()
    return (LidarSpeaker(names.FRONT_SCAN, clear_scan(names.FRONT_LIDAR), schedule.LIDAR),
            LidarSpeaker(names.REAR_SCAN, clear_scan(names.REAR_LIDAR), schedule.LIDAR),
            wheels, ImuSpeaker(wheels),
            Speaker(names.PERIPHERALS_STATE, PeripheralsState(alive=True, key_height_m=0.35, battery=1.0),
                    schedule.PERIPHERALS))


def clear_scan(frame: str) -> LaserScan:
    """A sweep in which walls far away alone are seen."""
    scan = LaserScan(angle_min=-FIELD_OF_VIEW_RAD / 2.0, angle_max=FIELD_OF_VIEW_RAD / 2.0,
                     angle_increment=FIELD_OF_VIEW_RAD / (BEAMS - 1), range_min=0.1, range_max=30.0,
                     ranges=[FAR_M] * BEAMS)
    scan.header.frame_id = frame
    return scan
