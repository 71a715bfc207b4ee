"""An inertial measurement unit with white noise, a constant bias and one that wanders slowly."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

import numpy as np

from mtr_core.errors import check_range

from .readings import ImuReading, Vector


@dataclass(frozen=True)
class ImuParameters:
    """Noise of a consumer MEMS sensor; densities from the data sheet of the Bosch BMI270, which names no bias walk.

    Attributes:
        gyro_density: white noise in rad/s/sqrt(Hz), 0 to 0.01; 0.007 deg/s/sqrt(Hz).
        accelerometer_density: in m/s2/sqrt(Hz), 0 to 0.1; 160 ug/sqrt(Hz).
        gyro_bias_radps: 1 sigma of the constant bias, 0 to 0.1; a calibrated sensor's 0.2 deg/s.
        accelerometer_bias_mps2: 1 sigma, 0 to 1; 5 mg after calibration.
        gyro_bias_walk: in rad/s/sqrt(s), 0 to 0.001; 8e-5 rad/s (17 deg/h) after 100 s, usual in its class.
        accelerometer_bias_walk: in m/s2/sqrt(s), 0 to 0.01.
    """

    gyro_density: float = math.radians(0.007)
    accelerometer_density: float = 160e-6 * 9.81
    gyro_bias_radps: float = math.radians(0.2)
    accelerometer_bias_mps2: float = 0.005 * 9.81
    gyro_bias_walk: float = 8e-6
    accelerometer_bias_walk: float = 1e-4

    def __post_init__(self) -> None:
        check_range("gyro_density", self.gyro_density, 0.0, 0.01, "rad/s/sqrt(Hz)")
        check_range("accelerometer_density", self.accelerometer_density, 0.0, 0.1, "m/s2/sqrt(Hz)")
        check_range("gyro_bias_radps", self.gyro_bias_radps, 0.0, 0.1, "rad/s")
        check_range("accelerometer_bias_mps2", self.accelerometer_bias_mps2, 0.0, 1.0, "m/s2")
        check_range("gyro_bias_walk", self.gyro_bias_walk, 0.0, 0.001, "rad/s/sqrt(s)")
        check_range("accelerometer_bias_walk", self.accelerometer_bias_walk, 0.0, 0.01, "m/s2/sqrt(s)")


class Imu:
    """Adds the errors to true means over one period."""

    def __init__(self, parameters: ImuParameters, period_s: float, noise: np.random.Generator):
        self._noise = noise
        # Gyro, then accelerometer, three axes each.
        self._white = np.repeat([parameters.gyro_density, parameters.accelerometer_density], 3) / math.sqrt(period_s)
        self._walk = np.repeat([parameters.gyro_bias_walk, parameters.accelerometer_bias_walk], 3) * math.sqrt(period_s)
        self._bias = noise.standard_normal(6) * np.repeat(
            [parameters.gyro_bias_radps, parameters.accelerometer_bias_mps2], 3)

    def read(self, angular_velocity: Vector, acceleration: Vector) -> ImuReading:
        """Reading for the true mean angular velocity and specific force in frame imu."""
        white, walk = self._noise.standard_normal((2, 6))
        self._bias += self._walk * walk
        error = (self._bias + self._white * white).tolist()
        return ImuReading(tuple(true + wrong for true, wrong in zip(angular_velocity, error[:3])),
                          tuple(true + wrong for true, wrong in zip(acceleration, error[3:])))
