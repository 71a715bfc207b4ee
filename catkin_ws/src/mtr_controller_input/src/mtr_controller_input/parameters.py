"""Parameters of the manual controller."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number

MAX_INDEX = 31


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the node is started with. Buttons and axes are indices of sensor_msgs/Joy.

    The defaults are those of the Jackal's PS4 controller: hold L1 to drive slowly, R1 to drive fast.

    Attributes:
        slow_button: dead-man button that allows slow driving.
        fast_button: dead-man button that allows fast driving.
        linear_axis: forward is positive.
        angular_axis: counterclockwise is positive.
        slow_mps, slow_radps: velocities at full deflection while slow.
        fast_mps, fast_radps: the same while fast.
        dead_zone: deflection below which an axis counts as released.
        silent_after_s: age of the newest message at which the controller counts as released.
    """

    slow_button: int = number(4, 0, MAX_INDEX)
    fast_button: int = number(5, 0, MAX_INDEX)
    linear_axis: int = number(1, 0, MAX_INDEX)
    angular_axis: int = number(0, 0, MAX_INDEX)
    slow_mps: float = number(0.4, 0.05, 2.0, "m/s")
    slow_radps: float = number(0.6, 0.05, 3.0, "rad/s")
    fast_mps: float = number(1.2, 0.05, 2.0, "m/s")
    fast_radps: float = number(1.2, 0.05, 3.0, "rad/s")
    dead_zone: float = number(0.05, 0.0, 0.5)
    silent_after_s: float = number(0.5, 0.1, 2.0, "s")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.slow_button == self.fast_button or self.linear_axis == self.angular_axis:
            raise ConfigurationError("The two dead-man buttons must differ, and so must the two axes; "
                                     f"they are {self.slow_button}, {self.fast_button} and "
                                     f"{self.linear_axis}, {self.angular_axis}.")
