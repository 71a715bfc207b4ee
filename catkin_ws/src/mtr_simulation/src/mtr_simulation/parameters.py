"""Parameters of the simulator node."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, fields
from typing import Any, Dict, Tuple

from mtr_core.errors import ConfigurationError, check_range

from .scenario import named_scenario


@dataclass(frozen=True)
class SimulatorParameters:
    """Checked when made.

    Attributes:
        seed: of every random number, 0 to 2^31 - 1.
        scenario: name of a test site.
        rear_lidar: the rear LiDAR exists.
        real_time_factor: simulated seconds per second, 0 (as fast as the control loop allows) to 100.
        hold_for: nodes whose first hold the clock waits for.
        car_port_link: path at which the Car's CAN adapter appears; empty: there is no Car's electronics.
        truth_dir: folder for the true events; empty: they are not written.
    """

    seed: int = 1
    scenario: str = "lot"
    rear_lidar: bool = True
    real_time_factor: float = 1.0
    hold_for: Tuple[str, ...] = ()
    car_port_link: str = ""
    truth_dir: str = ""

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**31 - 1, "(whole number)")
        check_range("real_time_factor", self.real_time_factor, 0.0, 100.0, "(ratio)")
        named_scenario(self.scenario)

    @classmethod
    def from_values(cls, values: Dict[str, Any]) -> "SimulatorParameters":
        """From a parameter server's values; unknown names and wrong types are refused."""
        kinds = {"seed": int, "scenario": str, "rear_lidar": bool, "real_time_factor": (int, float), "hold_for": list,
                 "car_port_link": str, "truth_dir": str}
        known = {field.name for field in fields(cls)}
        for name, value in values.items():
            if name not in known:
                raise ConfigurationError(f"Parameter {name} is unknown; allowed is {', '.join(sorted(known))}.")
            if not isinstance(value, kinds[name]) or (isinstance(value, bool) and kinds[name] is not bool):
                raise ConfigurationError(f"Parameter {name} is {value!r}; allowed is a value like "
                                         f"{getattr(cls, name)!r}.")
        hold_for = tuple(name if name.startswith("/") else f"/{name}" for name in values.get("hold_for", ()))
        return cls(**{**values, "hold_for": hold_for})
