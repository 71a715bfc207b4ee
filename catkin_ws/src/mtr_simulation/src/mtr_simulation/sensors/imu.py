"""An inertial measurement unit with white noise, a constant bias and one that wanders slowly."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

import numpy as np

from mtr_core.parameters import ParameterSet, number

from .readings import ImuReading, Vector


@dataclass(frozen=True)
class ImuParameters(ParameterSet):
    """Noise of a consumer MEMS sensor; densities from the data sheet of the Bosch BMI270, which names no bias walk.

    Attributes:
        gyro_density: white noise; 0.007 deg/s/sqrt(Hz).
        accelerometer_density: the same; 160 ug/sqrt(Hz).
        gyro_bias_radps: 1 sigma of the constant bias; a calibrated sensor's 0.2 deg/s.
        accelerometer_bias_mps2: 1 sigma; 5 mg after calibration.
        gyro_bias_walk: 8e-5 rad/s (17 deg/h) after 100 s, usual in its class.
        accelerometer_bias_walk: 1e-3 m/s2 after 100 s.
        gyro_scale_error: relative error of all angular velocities.
    """

    gyro_density: float = number(math.radians(0.007), 0.0, 0.01, "rad/s/sqrt(Hz)")
    accelerometer_density: float = number(160e-6 * 9.81, 0.0, 0.1, "m/s2/sqrt(Hz)")
    gyro_bias_radps: float = number(math.radians(0.2), 0.0, 0.1, "rad/s")
    accelerometer_bias_mps2: float = number(0.005 * 9.81, 0.0, 1.0, "m/s2")
    gyro_bias_walk: float = number(8e-6, 0.0, 0.001, "rad/s/sqrt(s)")
    accelerometer_bias_walk: float = number(1e-4, 0.0, 0.01, "m/s2/sqrt(s)")
    gyro_scale_error: float = number(0.0, -0.05, 0.05, "(relative)")


class Imu:
    """Adds the errors to true means over one period."""

    def __init__(self, parameters: ImuParameters, period_s: float, noise: np.random.Generator):
        self._noise, self._gyro_scale = noise, 1.0 + parameters.gyro_scale_error
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
        return ImuReading(tuple(self._gyro_scale * true + wrong for true, wrong in zip(angular_velocity, error[:3])),
                          tuple(true + wrong for true, wrong in zip(acceleration, error[3:])))
