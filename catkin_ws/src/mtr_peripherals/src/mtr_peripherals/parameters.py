"""Parameters of the peripherals' node, and reading them and the calibration from one namespace."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, dataclass
from typing import Any, Dict, Tuple

from mtr_core.errors import ConfigurationError, check_range

from .calibration import Calibration


@dataclass(frozen=True)
class Parameters:
    """What the node is started with, besides the calibration.

    Attributes:
        firmware_silent_after_s: age of the newest FirmwareState at which the firmware has failed, 0.2 to 5 s.
        order_silent_after_s: age of DesiredState and RobotMode at which they hold no longer, 0.2 to 5 s.
        battery_silent_after_s: age at which the battery's charge is unknown, 1 to 600 s.
    """

    firmware_silent_after_s: float = 1.0
    order_silent_after_s: float = 0.5
    battery_silent_after_s: float = 30.0

    def __post_init__(self) -> None:
        check_range("firmware_silent_after_s", self.firmware_silent_after_s, 0.2, 5.0, "s")
        check_range("order_silent_after_s", self.order_silent_after_s, 0.2, 5.0, "s")
        check_range("battery_silent_after_s", self.battery_silent_after_s, 1.0, 600.0, "s")


def parameters_from(values: Dict[str, Any]) -> Tuple[Parameters, Calibration]:
    """From the values of a parameter server; unknown names and wrong types are refused."""
    own, calibrated = asdict(Parameters()), asdict(Calibration())
    defaults = {**own, **calibrated}
    for name, value in values.items():
        if name not in defaults:
            raise ConfigurationError(f"Parameter {name} is unknown; allowed are {', '.join(sorted(defaults))}.")
        default = defaults[name]
        kind = (int, float) if isinstance(default, float) else (list, tuple)
        if not isinstance(value, kind) or isinstance(value, bool):
            raise ConfigurationError(f"Parameter {name} is {value!r}; allowed is a value like {default!r}.")
    return (Parameters(**{name: value for name, value in values.items() if name in own}),
            Calibration(**{name: value for name, value in values.items() if name in calibrated}))
