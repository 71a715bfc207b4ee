"""Timing of the sensors: each has its own clock, as on a robot, so that no two are synchronous for long."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class SensorTiming(ParameterSet):
    """Periods and phases in ms of the simulated clock.

    The periods of the two LiDARs differ like those of two motors of one type: they coincide every 16 s. The phases of
    IMU and odometry are independent of the ticks of the robot's nodes, which are multiples of 20 ms.

    Attributes:
        front_lidar_period_ms, rear_lidar_period_ms: of one turn.
        truth_period_ms: of pose, key and lift, which are not sensors; its phase is 0.
    """

    front_lidar_period_ms: float = number(40.0, 20.0, 200.0, "ms")
    front_lidar_phase_ms: float = number(7.0, 0.0, 200.0, "ms")
    rear_lidar_period_ms: float = number(40.1, 20.0, 200.0, "ms")
    rear_lidar_phase_ms: float = number(26.0, 0.0, 200.0, "ms")
    imu_period_ms: float = number(10.0, 5.0, 20.0, "ms")
    imu_phase_ms: float = number(3.0, 0.0, 20.0, "ms")
    odometry_period_ms: float = number(20.0, 10.0, 20.0, "ms")
    odometry_phase_ms: float = number(13.0, 0.0, 20.0, "ms")
    clock_period_ms: float = number(10.0, 1.0, 20.0, "ms")
    truth_period_ms: float = number(20.0, 20.0, 20.0, "ms")
