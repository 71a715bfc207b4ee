"""Configuration of the base's own controller: what it does with a velocity command, and without one."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from dataclasses import dataclass
from typing import Any, Dict

import yaml

from mtr_core.errors import ConfigurationError

CONTROLLER = "jackal_velocity_controller"


@dataclass(frozen=True)
class BaseController:
    """Limits of a diff_drive_controller.

    Attributes:
        command_timeout_s: it stops so long after the last command.
        max_linear_mps, max_angular_radps: of the commanded velocity.
        linear_acceleration_mps2, angular_acceleration_radps2: of starts and stops, that by time-out included.
    """

    command_timeout_s: float
    max_linear_mps: float
    max_angular_radps: float
    linear_acceleration_mps2: float
    angular_acceleration_radps2: float


def base_parameters_in(path: pathlib.Path) -> Dict[str, Any]:
    """The controller's parameters of a file, for the parameter server; ConfigurationError when there are none."""
    try:
        values: Dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))[CONTROLLER]
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError) as error:
        raise _unusable(str(path), error) from error
    return values


def base_controller_in(path: pathlib.Path) -> BaseController:
    """The controller that a file of parameters configures; ConfigurationError when it does not."""
    return base_controller_of(base_parameters_in(path), str(path))


def base_controller_of(values: Dict[str, Any], where: str) -> BaseController:
    """The same of parameters that were loaded from a place."""
    try:
        linear, angular = values["linear"]["x"], values["angular"]["z"]
        return BaseController(
            *(float(value) for value in (values["cmd_vel_timeout"], linear["max_velocity"], angular["max_velocity"],
                                         linear["max_acceleration"], angular["max_acceleration"])))
    except (KeyError, TypeError, ValueError) as error:
        raise _unusable(where, error) from error


def _unusable(where: str, error: Exception) -> ConfigurationError:
    return ConfigurationError(f"{where} cannot be used; allowed are parameters of {CONTROLLER} ({error}).")
