"""Robot, firmware and Car together, one tick at a time."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Optional, Set

from mtr_core.se2 import Pose2

from .car.can_port import CanPort
from .equipment import Equipment
from .parameters import SimulatorParameters
from .physics.robot import RobotModel
from .physics.wheels import BaseParameters
from .sensors.readings import Sensors
from .sim import Sim, SimParameters
from .site.scenario_file import chosen_scenario
from .true_state import TrueState


class World:
    """The firmware moves lift and servos, robot and lift carry the key, and the Car detects the key.

    Attributes:
        sim: robot and sensors.
        equipment: the peripherals' firmware and the Car.
        truth: true state after the last step.
        contacts: bodies that the robot touches after the last step.
    """

    def __init__(self, parameters: SimulatorParameters, firmware: Optional[Any] = None,
                 robot: Optional[RobotModel] = None, base: Optional[BaseParameters] = None,
                 port: Optional[CanPort] = None):
        """port: receives the frames of the Car's bus instead of an adapter."""
        scenario = chosen_scenario(parameters.scenario)
        self._world_from_car = scenario.world_from_car
        self.sim = Sim(parameters.seed, scenario, SimParameters(rear_lidar=parameters.rear_lidar,
                                                                 base=base or BaseParameters()), robot)
        self.equipment = Equipment(parameters, firmware, port)
        self.truth: TrueState = self.sim.truth()
        self.contacts: Set[str] = set()

    @property
    def firmware(self) -> Any:
        """Firmware of the peripherals, simulated in this process or emulated."""
        return self.equipment.firmware

    def step(self) -> Sensors:
        """Advance one tick of 20 ms."""
        self.equipment.begin_step()
        sensors = self.sim.step()
        self.equipment.step()
        self.sim.set_lift(self.firmware.lift_height_m)
        self.truth = self.sim.truth()
        self.contacts = self.sim.contacts()
        self.equipment.see(self.truth.key_in_car, self.truth.car_from_base.heading)
        return sensors

    def kidnap(self, car_from_base: Pose2) -> None:
        """Put the robot down elsewhere, in the Car's frame."""
        self.sim.kidnap(self._world_from_car @ car_from_base)

    def close(self) -> None:
        """Remove the CAN adapter, end the firmware, and close the truth's file."""
        self.equipment.close()
