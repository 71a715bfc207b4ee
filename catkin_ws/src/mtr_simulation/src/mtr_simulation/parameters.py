"""Parameters of the simulator node."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.parameters import ParameterSet, number

from .car.choice import chosen_car
from .site.scenario_file import chosen_scenario


@dataclass(frozen=True)
class EquipmentParameters(ParameterSet):
    """Parameters of the peripherals' firmware and the Car.

    Attributes:
        seed: seed of every random number.
        car: name of a shipped Car or path of a Car's file, which defines its radio and electronics.
        car_port_link: path of the Car's CAN adapter; empty: the Car has no electronics.
        truth_dir: folder for the true events; empty: they are not written.
    """

    seed: int = number(1, 0, 2**31 - 1)
    car: str = "gentle"
    car_port_link: str = ""
    truth_dir: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        chosen_car(self.car)


@dataclass(frozen=True)
class SimulatorParameters(EquipmentParameters):
    """Parameters of the simulator.

    Attributes:
        scenario: name of a test site, or path of a site's YAML file.
        rear_lidar: the rear LiDAR exists.
        real_time_factor: simulated seconds per second; 0: as fast as the control loop allows.
        hold_for: nodes for whose first hold the clock waits.
        firmware_elf: firmware for an emulated ATmega2560; empty: the firmware is simulated.
    """

    scenario: str = "lot"
    rear_lidar: bool = True
    real_time_factor: float = number(1.0, 0.0, 100.0)
    hold_for: Tuple[str, ...] = ()
    firmware_elf: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        chosen_scenario(self.scenario)

    @property
    def held_by(self) -> Tuple[str, ...]:
        """Full names of the nodes in hold_for."""
        return tuple(f"/{name.lstrip('/')}" for name in self.hold_for)
