"""Error tree of the robot's nodes.

RobotError
└── ConfigurationError   a parameter is missing or out of range; the node does not start
"""
# SPDX-License-Identifier: Apache-2.0


class RobotError(Exception):
    """Base of all errors that the robot's own code raises; its text is one sentence for a person."""


class ConfigurationError(RobotError):
    """A parameter is missing or out of range."""


def check_range(name: str, value: float, low: float, high: float, unit: str) -> float:
    """Return value when low <= value <= high; else raise ConfigurationError naming parameter, value and range."""
    if not low <= value <= high:
        raise ConfigurationError(f"Parameter {name} is {value:g} {unit}; allowed is {low:g} to {high:g} {unit}.")
    return value
