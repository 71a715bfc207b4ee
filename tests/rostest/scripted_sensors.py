"""Scripted sensors of a robot that stands on open ground with a low key."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

from nav_msgs.msg import Odometry
from scripted_time import Speaker
from sensor_msgs.msg import LaserScan

from mtr_core import names, schedule
from mtr_msgs.msg import PeripheralsState

BEAMS = 90
FIELD_OF_VIEW_RAD = 1.5 * math.pi
MILLIMETRE = 0.001
TWO_SWEEPS_NS = 2 * schedule.LIDAR.period_ns


class LidarSpeaker(Speaker):
    """A LiDAR whose ranges change a little with every sweep, as a live one's do."""

    def speak(self, tick_ns: int) -> None:
        """Say the sweep if it is time."""
        self.message.ranges = [value + (MILLIMETRE if tick_ns % TWO_SWEEPS_NS else -MILLIMETRE)
                               for value in self.message.ranges]
        super().speak(tick_ns)


def open_ground() -> Tuple[Speaker, Speaker, Speaker, Speaker]:
    """Speakers of front LiDAR, rear LiDAR, odometry and peripherals."""
    odometry = Odometry()
    odometry.pose.pose.orientation.w = 1.0
    return (LidarSpeaker(names.FRONT_SCAN, clear_scan(names.FRONT_LIDAR), schedule.LIDAR),
            LidarSpeaker(names.REAR_SCAN, clear_scan(names.REAR_LIDAR), schedule.LIDAR),
            Speaker(names.WHEEL_ODOMETRY, odometry, schedule.SENSORS),
            Speaker(names.PERIPHERALS_STATE, PeripheralsState(alive=True, key_height_m=0.35), schedule.PERIPHERALS))


def clear_scan(frame: str) -> LaserScan:
    """A sweep in which nothing is in reach."""
    scan = LaserScan(angle_min=-FIELD_OF_VIEW_RAD / 2.0, angle_max=FIELD_OF_VIEW_RAD / 2.0,
                     angle_increment=FIELD_OF_VIEW_RAD / (BEAMS - 1), range_min=0.1, range_max=30.0,
                     ranges=[math.inf] * BEAMS)
    scan.header.frame_id = frame
    return scan
