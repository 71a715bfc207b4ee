"""Parameters of the dispatcher."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, dataclass
from typing import Any, Dict

from mtr_core.errors import ConfigurationError, check_range


@dataclass(frozen=True)
class Parameters:
    """What the dispatcher is started with.

    Attributes:
        bind_address: address on which both ports listen; "0.0.0.0" for all interfaces.
        status_port: TCP port on which Status is published, 1 to 65535.
        command_port: TCP port on which Command is received, 1 to 65535.
        lockstep_operator: simulated time waits for the application's answer to each Status.
        operator_lost_after_wall_s: wall time after which it stops waiting, 0.1 to 60 s.
        link_timeout_s: silence after which the robot stops, 0.2 to 5 s.
        command_lifetime_s: age of the answered Status at which a Command has expired, 0.2 to 5 s.
        takeover_after_s: silence of the application in control after which another may take over, 1 to 60 s.
        default_speed_mps: maximum speed when a Command names none, 0.05 to 2 m/s.
        platform_speed_mps: highest maximum speed that a Command may ask for, 0.05 to 2 m/s (Jackal data sheet).
        key_x_m: Remote key in base_link, -1 to 1 m.
        key_y_m: Remote key in base_link, -1 to 1 m.
        low_battery: charge below which the Operator is warned, 0 to 1.
    """

    bind_address: str = "127.0.0.1"
    status_port: int = 3334
    command_port: int = 3333
    lockstep_operator: bool = False
    operator_lost_after_wall_s: float = 5.0
    link_timeout_s: float = 1.0
    command_lifetime_s: float = 1.0
    takeover_after_s: float = 3.0
    default_speed_mps: float = 0.5
    platform_speed_mps: float = 2.0
    key_x_m: float = 0.25
    key_y_m: float = 0.0
    low_battery: float = 0.2

    def __post_init__(self) -> None:
        check_range("status_port", self.status_port, 1, 65535, "")
        check_range("command_port", self.command_port, 1, 65535, "")
        check_range("operator_lost_after_wall_s", self.operator_lost_after_wall_s, 0.1, 60.0, "s")
        check_range("link_timeout_s", self.link_timeout_s, 0.2, 5.0, "s")
        check_range("command_lifetime_s", self.command_lifetime_s, 0.2, 5.0, "s")
        check_range("takeover_after_s", self.takeover_after_s, 1.0, 60.0, "s")
        check_range("platform_speed_mps", self.platform_speed_mps, 0.05, 2.0, "m/s")
        check_range("default_speed_mps", self.default_speed_mps, 0.05, self.platform_speed_mps, "m/s")
        check_range("key_x_m", self.key_x_m, -1.0, 1.0, "m")
        check_range("key_y_m", self.key_y_m, -1.0, 1.0, "m")
        check_range("low_battery", self.low_battery, 0.0, 1.0, "")
        if self.status_port == self.command_port:
            raise ConfigurationError(f"Parameters status_port and command_port are both {self.status_port}; "
                                     "they must differ.")


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
