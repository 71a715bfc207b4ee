"""Readings of the simulated sensors in plain types; times are integer ns of the simulated clock."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

Vector = Tuple[float, float, float]
# Variances of a Jackal's odometry: x, y, z, roll, pitch, yaw.
ODOMETRY_VARIANCES = (0.001, 0.001, 1e6, 1e6, 1e6, 0.03)


class Scan(NamedTuple):
    """One sweep of a LiDAR; stamp_ns is the time of the first beam, angles in the LiDAR's own frame.

    ranges_m is float32; +inf: nothing within range_max_m, -inf: an obstacle nearer than range_min_m (REP-117).
    """

    stamp_ns: int
    angle_min_rad: float
    angle_increment_rad: float
    time_increment_s: float
    scan_time_s: float
    range_min_m: float
    range_max_m: float
    ranges_m: FloatArray


class ImuReading(NamedTuple):
    """Means over the last sensor period, in frame imu: rad/s and m/s2, gravity included."""

    angular_velocity: Vector
    acceleration: Vector


class WheelOdometry(NamedTuple):
    """Odometry that the base computes from its wheels: mean speed over the last period, and the integrated pose."""

    x_m: float
    y_m: float
    heading_rad: float
    linear_mps: float
    angular_radps: float


class BatteryReading(NamedTuple):
    """State of charge 0 to 1, voltage in V, current in A (negative: discharging)."""

    charge: float
    voltage_v: float
    current_a: float


class Sensors(NamedTuple):
    """New readings of one tick; a scan is None if no sweep was completed or the LiDAR is switched off."""

    time_ns: int
    imu: ImuReading
    odometry: WheelOdometry
    battery: BatteryReading
    front_scan: Optional[Scan]
    rear_scan: Optional[Scan]

    def to_bytes(self) -> bytes:
        """Return all readings as bytes, so that two runs can be compared by a hash."""
        numbers = (self.time_ns, *self.imu.angular_velocity, *self.imu.acceleration, *self.odometry, *self.battery)
        scans = (scan.ranges_m.tobytes() for scan in (self.front_scan, self.rear_scan) if scan)
        return np.array(numbers, dtype=np.float64).tobytes() + b"".join(scans)
