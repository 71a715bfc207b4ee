"""Evaluation of the accelerometer: upward direction, and direction of the robot's acceleration."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from .recording import ImuSample, Recording, WheelSample

# Half the time over which the wheels' velocity is differentiated and the force is averaged, and interval of these
# times.
HALF_WINDOW_S, SPACING_S = 0.1, 0.05
# Neighbouring windows share their data, which reduces the number of independent ones.
OVERLAP = 2.0 * HALF_WINDOW_S / SPACING_S
# In a turn the accelerometer also measures the centripetal acceleration.
MAX_TURN_RADPS = 0.15
# Minimum acceleration of starts and stops that count, and their minimum number.
MIN_ACCELERATION_MPS2, MIN_ACCELERATED = 0.2, 6
# Beyond this standard error the accelerometer is undecided.
MAX_SIGMA = 0.25


class Gravity(NamedTuple):
    """Specific force at rest: its magnitude in m/s2, its angle from the IMU's z axis in rad, the axis nearest to it."""

    size_mps2: float
    tilt_rad: float
    axis: str


class Thrust(NamedTuple):
    """Specific force for each m/s2 of the wheels' acceleration, along x and y of the IMU, with its sigma."""

    x: float
    y: float
    sigma: float

    @property
    def angle_rad(self) -> float:
        """Direction of the wheels' forward in the IMU's plane."""
        return math.atan2(self.y, self.x)


def gravity(imu: List[ImuSample]) -> Optional[Gravity]:
    """Return gravity from the medians of the axes, which suppress starts and stops; None without samples."""
    if not imu:
        return None
    force = np.median([sample.force_mps2 for sample in imu], axis=0)
    size = float(np.linalg.norm(force))
    if size == 0.0 or not math.isfinite(size):
        return Gravity(size, math.nan, "no axis")
    largest = int(np.argmax(np.abs(force)))
    return Gravity(size, math.acos(float(force[2]) / size), f"{'+' if force[largest] > 0.0 else '-'}{'xyz'[largest]}")


def thrust(recording: Recording) -> Optional[Thrust]:
    """Return the thrust; None unless the robot was started and stopped hard enough on a straight line."""
    rows = accelerations(recording)
    if sum(abs(row[0]) >= MIN_ACCELERATION_MPS2 for row in rows) < MIN_ACCELERATED:
        return None
    table: FloatArray = np.array(rows) - np.mean(rows, axis=0)
    gained, felt = table[:, 0], table[:, 1:]
    power = float(gained @ gained)
    x, y = (gained @ felt / power).tolist()
    left = felt - np.outer(gained, (x, y))
    sigma = math.sqrt(OVERLAP * float((left ** 2).sum()) / len(rows) / power)
    return Thrust(x, y, sigma) if sigma <= MAX_SIGMA else None


def accelerations(recording: Recording) -> List[Tuple[float, float, float]]:
    """Return the wheels' acceleration with the mean force along x and y, at times on straight lines."""
    wheels, imu = recording.wheels, recording.imu
    if not wheels or not imu:
        return []
    wheel_s = np.array([sample.time_s for sample in wheels])
    imu_s = np.array([sample.time_s for sample in imu])
    impulse = np.vstack([np.zeros(2), np.cumsum(
        np.diff(imu_s)[:, np.newaxis] * np.array([sample.force_mps2[:2] for sample in imu])[1:], axis=0)])
    start, end = max(wheel_s[0], imu_s[0]) + HALF_WINDOW_S, min(wheel_s[-1], imu_s[-1]) - HALF_WINDOW_S
    times = np.arange(start, end, SPACING_S)
    times = times[np.interp(times, wheel_s, turning_rates(wheels)) < MAX_TURN_RADPS]
    speed = [np.interp(times + shift, wheel_s, [sample.linear_mps for sample in wheels])
             for shift in (-HALF_WINDOW_S, HALF_WINDOW_S)]
    felt = [[np.interp(times + shift, imu_s, impulse[:, axis]) for shift in (-HALF_WINDOW_S, HALF_WINDOW_S)]
            for axis in (0, 1)]
    gained, x, y = ((after - before) / (2.0 * HALF_WINDOW_S) for before, after in (speed, *felt))
    return list(zip(gained.tolist(), x.tolist(), y.tolist()))


def turning_rates(wheels: List[WheelSample]) -> FloatArray:
    """Return the rotation rates without sign."""
    rates: FloatArray = np.abs([sample.angular_radps for sample in wheels])
    return rates
