"""Parameters of the manual controller."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, dataclass
from typing import Any, Dict

from mtr_core.errors import ConfigurationError, check_range

MAX_INDEX = 31


@dataclass(frozen=True)
class Parameters:
    """What the node is started with. Buttons and axes are indices of sensor_msgs/Joy, 0 to 31.

    The defaults are those of the Jackal's PS4 controller: hold L1 to drive slowly, R1 to drive fast.

    Attributes:
        slow_button: dead-man button that allows slow driving.
        fast_button: dead-man button that allows fast driving.
        linear_axis: forward is positive.
        angular_axis: counterclockwise is positive.
        slow_mps, slow_radps: velocities at full deflection while slow, 0.05 to 2 m/s and 0.05 to 3 rad/s.
        fast_mps, fast_radps: the same while fast.
        dead_zone: deflection below which an axis counts as released, 0 to 0.5.
        silent_after_s: age of the newest message at which the controller counts as released, 0.1 to 2 s.
    """

    slow_button: int = 4
    fast_button: int = 5
    linear_axis: int = 1
    angular_axis: int = 0
    slow_mps: float = 0.4
    slow_radps: float = 0.6
    fast_mps: float = 1.2
    fast_radps: float = 1.2
    dead_zone: float = 0.05
    silent_after_s: float = 0.5

    def __post_init__(self) -> None:
        for name in ("slow_button", "fast_button", "linear_axis", "angular_axis"):
            check_range(name, getattr(self, name), 0, MAX_INDEX, "")
        for name in ("slow_mps", "fast_mps"):
            check_range(name, getattr(self, name), 0.05, 2.0, "m/s")
        for name in ("slow_radps", "fast_radps"):
            check_range(name, getattr(self, name), 0.05, 3.0, "rad/s")
        check_range("dead_zone", self.dead_zone, 0.0, 0.5, "")
        check_range("silent_after_s", self.silent_after_s, 0.1, 2.0, "s")
        if self.slow_button == self.fast_button or self.linear_axis == self.angular_axis:
            raise ConfigurationError("The two dead-man buttons must differ, and so must the two axes; "
                                     f"they are {self.slow_button}, {self.fast_button} and "
                                     f"{self.linear_axis}, {self.angular_axis}.")


def parameters_from(values: Dict[str, Any]) -> Parameters:
    """From the values of a parameter server; unknown names and wrong types are refused."""
    defaults = asdict(Parameters())
    for name, value in values.items():
        if name not in defaults:
            raise ConfigurationError(f"Parameter {name} is unknown; allowed are {', '.join(sorted(defaults))}.")
        default = defaults[name]
        kind = (int, float) if isinstance(default, float) else type(default)
        if not isinstance(value, kind) or isinstance(value, bool) is not isinstance(default, bool):
            raise ConfigurationError(f"Parameter {name} is {value!r}; allowed is a value like {default!r}.")
    return Parameters(**values)
