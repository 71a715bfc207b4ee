"""Error tree of the robot's nodes.

RobotError
└── ConfigurationError   a parameter is missing or out of range; the node does not start
"""
# SPDX-License-Identifier: Apache-2.0


class RobotError(Exception):
    """Base of all errors that the robot's own code raises; its text is one sentence for a person."""


class ConfigurationError(RobotError):
    """A parameter is missing or out of range."""


def range_problem(name: str, value: float, low: float, high: float, unit: str = "") -> str:
    """Return a sentence with value and range if the value is out of range, as NaN always is; otherwise empty."""
    if low <= value <= high:
        return ""
    unit = f" {unit}" if unit else ""
    return f"{name} is {figure(value)}{unit}; allowed is {figure(low)} to {figure(high)}{unit}."


def figure(value: float) -> str:
    """Return the number for display: whole numbers in full, others with six digits."""
    return str(value) if isinstance(value, int) else f"{value:g}"


def check_range(name: str, value: float, low: float, high: float, unit: str = "") -> float:
    """Return the value if low <= value <= high; raise ConfigurationError with parameter, value and range otherwise."""
    problem = range_problem(f"Parameter {name}", value, low, high, unit)
    if problem:
        raise ConfigurationError(problem)
    return value
