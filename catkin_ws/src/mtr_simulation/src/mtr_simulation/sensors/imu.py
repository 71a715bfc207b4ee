"""Inertial measurement unit with white noise, a constant bias and a slowly wandering bias."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

import numpy as np

from mtr_core import sensor_figures as figures
from mtr_core.parameters import ParameterSet, number

from .readings import ImuReading, Vector


@dataclass(frozen=True)
class ImuParameters(ParameterSet):
    """Noise of a consumer MEMS sensor; figures and their sources are in mtr_core.sensor_figures.

    Attributes:
        gyro_density, accelerometer_density: white noise.
        gyro_bias_radps, accelerometer_bias_mps2: 1 sigma of the constant bias.
        gyro_bias_walk, accelerometer_bias_walk: random walk of the bias, 1 sigma after 1 s.
        gyro_scale_error: relative error of all angular velocities.
    """

    gyro_density: float = number(*figures.SIMULATED_GYRO_NOISE_RADPS_PER_SQRT_HZ)
    accelerometer_density: float = number(*figures.SIMULATED_ACCELEROMETER_NOISE_MPS2_PER_SQRT_HZ)
    gyro_bias_radps: float = number(*figures.SIMULATED_GYRO_BIAS_RADPS)
    accelerometer_bias_mps2: float = number(*figures.SIMULATED_ACCELEROMETER_BIAS_MPS2)
    gyro_bias_walk: float = number(*figures.SIMULATED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S)
    accelerometer_bias_walk: float = number(*figures.SIMULATED_ACCELEROMETER_BIAS_WALK_MPS2_PER_SQRT_S)
    gyro_scale_error: float = number(*figures.SIMULATED_GYRO_SCALE_ERROR)


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
        """Return the reading for the true mean angular velocity and specific force in frame imu."""
        white, walk = self._noise.standard_normal((2, 6))
        self._bias += self._walk * walk
        error = (self._bias + self._white * white).tolist()
        return ImuReading(tuple(self._gyro_scale * true + wrong for true, wrong in zip(angular_velocity, error[:3])),
                          tuple(true + wrong for true, wrong in zip(acceleration, error[3:])))
