"""Configuration of the base's own controller: limits of velocity commands, and the command time-out."""
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
        command_timeout_s: time from the last command to the stop.
        max_linear_mps, max_angular_radps: of the commanded velocity.
        linear_acceleration_mps2, angular_acceleration_radps2: of starts and stops, including the time-out.
    """

    command_timeout_s: float
    max_linear_mps: float
    max_angular_radps: float
    linear_acceleration_mps2: float
    angular_acceleration_radps2: float


def base_parameters_in(path: pathlib.Path) -> Dict[str, Any]:
    """Return the controller's parameters of a file, for the parameter server; ConfigurationError without any."""
    try:
        values: Dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))[CONTROLLER]
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError) as error:
        raise _unusable(str(path), error) from error
    return values


def base_controller_in(path: pathlib.Path) -> BaseController:
    """Return the controller configured in a parameter file; ConfigurationError for an invalid file."""
    return base_controller_of(base_parameters_in(path), str(path))


def base_controller_of(values: Dict[str, Any], where: str) -> BaseController:
    """Return the controller of loaded parameters. where: their source, for the sentence of an error."""
    try:
        linear, angular = values["linear"]["x"], values["angular"]["z"]
        return BaseController(
            *(float(value) for value in (values["cmd_vel_timeout"], linear["max_velocity"], angular["max_velocity"],
                                         linear["max_acceleration"], angular["max_acceleration"])))
    except (KeyError, TypeError, ValueError) as error:
        raise _unusable(where, error) from error


def _unusable(where: str, error: Exception) -> ConfigurationError:
    return ConfigurationError(f"{where} cannot be used; allowed are parameters of {CONTROLLER} ({error}).")
