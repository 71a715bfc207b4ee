"""Base controller: converts velocity commands to wheel speeds, and wheel angles to odometry.

It works like the diff_drive_controller of a Jackal. It limits speed and acceleration, and stops without commands. A
multiplier widens the track, because a skid-steered robot turns slower than its wheels indicate.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List

import mujoco

from mtr_core import sensor_figures as figures
from mtr_core.parameters import ParameterSet, number
from mtr_description.base_controller import BaseController
from mtr_description.shipped import shipped_base

from ..sensors.readings import WheelOdometry
from .robot import WHEELS, RobotModel

INTEGRAL_GAIN_PER_S = 6.0
INTEGRAL_LIMIT_RADPS = 3.0
BASE = shipped_base()


@dataclass(frozen=True)
class BaseParameters(ParameterSet):
    """Limits of the platform: mtr_description's jackal_base.yaml unless others are loaded, as on a real robot.

    Attributes:
        max_linear_mps, max_angular_radps: limits of the commanded velocity.
        max_linear_mps2: limit of starts and stops; the 20 of a bare Jackal would tip a robot with a mast.
        max_angular_radps2: limit of the angular acceleration; a bare Jackal has 25.
        command_timeout_s: time after the last command at which the base stops.
        separation_multiplier: factor by which the track is widened; a Jackal's is 1.5.
        radius_error: relative error of the wheel radius that the base assumes.
        encoder_ticks_per_m: a Jackal's is 78000.
        max_wheel_torque_nm: limit of each wheel.
    """

    max_linear_mps: float = number(BASE.max_linear_mps, 0.1, 3.0, "m/s")
    max_angular_radps: float = number(BASE.max_angular_radps, 0.1, 6.0, "rad/s")
    max_linear_mps2: float = number(BASE.linear_acceleration_mps2, 0.1, 20.0, "m/s2")
    max_angular_radps2: float = number(BASE.angular_acceleration_radps2, 0.1, 25.0, "rad/s2")
    command_timeout_s: float = number(BASE.command_timeout_s, 0.05, 1.0, "s")
    separation_multiplier: float = number(1.5, 1.0, 3.0, "(ratio)")
    radius_error: float = number(*figures.SIMULATED_WHEEL_RADIUS_ERROR)
    encoder_ticks_per_m: float = number(78_000.0, 1e3, 1e6, "1/m")
    max_wheel_torque_nm: float = number(6.0, 1.0, 30.0, "Nm")


def parameters_of(base: BaseController) -> BaseParameters:
    """Return the platform with this controller configuration.

    Raises:
        ConfigurationError: such a platform cannot be simulated.
    """
    return BaseParameters(base.max_linear_mps, base.max_angular_radps, base.linear_acceleration_mps2,
                          base.angular_acceleration_radps2, base.command_timeout_s)


class Wheels:
    """Drives the four wheel servos and reads their encoders."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotModel, parameters: BaseParameters):
        self._data, self._parameters = data, parameters
        self._step_s = model.opt.timestep
        self._dofs = [int(model.joint(name).dofadr[0]) for name in WHEELS]
        self._angles = [int(model.joint(name).qposadr[0]) for name in WHEELS]
        self._servos = [model.actuator(name).id for name in WHEELS]
        self._integrals = [0.0] * len(WHEELS)
        self._radius_m = robot.wheel_radius_m * (1.0 + parameters.radius_error)
        self._half_track_m = robot.half_track_m * parameters.separation_multiplier
        self._wanted = (0.0, 0.0)
        self._silent_s = math.inf
        self._linear = self._angular = 0.0
        self._ticks = [0.0, 0.0]
        self._pose = (0.0, 0.0, 0.0)

    def command(self, linear_mps: float, angular_radps: float) -> None:
        """Set a new velocity command; a non-finite one is ignored."""
        if math.isfinite(linear_mps) and math.isfinite(angular_radps):
            limits = self._parameters
            self._wanted = (_clip(linear_mps, limits.max_linear_mps), _clip(angular_radps, limits.max_angular_radps))
            self._silent_s = 0.0

    def drive(self) -> None:
        """Set the servos for one physics step."""
        step, limits, data = self._step_s, self._parameters, self._data
        linear, angular = self._wanted if self._silent_s < limits.command_timeout_s else (0.0, 0.0)
        self._silent_s += step
        self._linear += _clip(linear - self._linear, limits.max_linear_mps2 * step)
        self._angular += _clip(angular - self._angular, limits.max_angular_radps2 * step)
        turn = self._angular * self._half_track_m
        left, right = (self._linear - turn) / self._radius_m, (self._linear + turn) / self._radius_m
        speeds, integrals, control = data.qvel, self._integrals, data.ctrl
        for index, target in enumerate((left, right, left, right)):
            error = target - float(speeds[self._dofs[index]])
            integrals[index] = _clip(integrals[index] + INTEGRAL_GAIN_PER_S * error * step, INTEGRAL_LIMIT_RADPS)
            control[self._servos[index]] = target + integrals[index]

    def odometry(self, period_s: float) -> WheelOdometry:
        """Return the odometry of the period since the last call."""
        ticks = self._count()
        per_m = self._parameters.encoder_ticks_per_m
        left, right = ((new - old) / per_m for new, old in zip(ticks, self._ticks))
        self._ticks = ticks
        distance, turn = 0.5 * (left + right), (right - left) / (2.0 * self._half_track_m)
        x, y, heading = self._pose
        x, y = x + distance * math.cos(heading + turn / 2.0), y + distance * math.sin(heading + turn / 2.0)
        self._pose = (x, y, heading + turn)
        return WheelOdometry(x, y, heading + turn, distance / period_s, turn / period_s)

    def _count(self) -> List[float]:
        """Return the encoder ticks of the left and the right side, scaled by the assumed wheel radius."""
        angles = [float(self._data.qpos[index]) for index in self._angles]
        scale = self._radius_m * self._parameters.encoder_ticks_per_m
        return [math.floor(0.5 * (angles[side] + angles[side + 2]) * scale) for side in (0, 1)]


def _clip(value: float, limit: float) -> float:
    return limit if value > limit else -limit if value < -limit else value
