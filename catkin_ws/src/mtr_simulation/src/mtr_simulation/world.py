"""Robot, firmware and Car together, one tick at a time."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Mapping, Optional, Set

from mtr_core.schedule import CLOCK_STEP, SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_fault_injection import parts
from mtr_fault_injection.parts import Kind

from .car.choice import Car, chosen_car
from .car.ecu import Command
from .car.slcan_port import Fault, SlcanPort
from .firmware.simulated import SimulatedFirmware
from .parameters import SimulatorParameters
from .physics.robot import RobotModel
from .physics.wheels import BaseParameters
from .sensors.readings import Sensors
from .sim import Sim, SimParameters
from .site.scenario import named_scenario
from .true_state import TrueState
from .truth.log import EventLog, NoTruthLog, TruthLog

CAN_FAULTS = {Kind.OFF.value: Fault.SILENCE, Kind.GARBAGE.value: Fault.GARBAGE, Kind.STOP.value: Fault.BUS_OFF}


class World:
    """The firmware moves lift and servos, the key goes where robot and lift carry it, and the Car sees the key.

    Attributes:
        sim: robot and sensors.
        firmware: of the peripherals, simulated in this process or emulated.
        truth: true state after the last step.
        contacts: what the robot touches after the last step.
    """

    def __init__(self, parameters: SimulatorParameters, firmware: Optional[Any] = None,
                 robot: Optional[RobotModel] = None, base: Optional[BaseParameters] = None):
        scenario = named_scenario(parameters.scenario)
        self._world_from_car = scenario.world_from_car
        self.sim = Sim(parameters.seed, scenario, SimParameters(rear_lidar=parameters.rear_lidar,
                                                                 base=base or BaseParameters()), robot)
        # The firmware's clock is the simulated one; that of a real board starts anywhere.
        self.firmware = firmware or SimulatedFirmware(clock_start_us=SIMULATION_START_NS // 1000)
        self.firmware.start(SIMULATION_START_NS)
        self.truth: TrueState = self.sim.truth()
        self.contacts: Set[str] = set()
        self._truth_log: EventLog = TruthLog(parameters.truth_dir) if parameters.truth_dir else NoTruthLog()
        self._port: Optional[SlcanPort] = None
        self._car: Optional[Car] = None
        if parameters.car_port_link:
            self._port = SlcanPort(parameters.car_port_link)
            self._car = chosen_car(parameters.car).car(parameters.seed, self._port, self._truth_log)

    def step(self) -> Sensors:
        """Advance one tick of 20 ms."""
        self.firmware.begin_step(self.sim.time_ns + CLOCK_STEP.period_ns)
        sensors = self.sim.step()
        self.firmware.step(sensors.time_ns)
        self.sim.set_lift(self.firmware.lift_height_m)
        self.truth = self.sim.truth()
        self.contacts = self.sim.contacts()
        if self._car:
            self._car.step(sensors.time_ns, self.truth.key_in_car, self.firmware.servo_us,
                           self.truth.car_from_base.heading)
        return sensors

    def request_handle(self, locks: bool) -> None:
        """A hand takes the Car's handle, to lock or to open it."""
        if self._car:
            self._car.request_handle(Command.LOCK if locks else Command.UNLOCK)

    def kidnap(self, car_from_base: Pose2) -> None:
        """Somebody lifts the robot and puts it down elsewhere, in the Car's frame."""
        self.sim.kidnap(self._world_from_car @ car_from_base)

    def set_faults(self, faults: Mapping[str, str]) -> None:
        """What parts of the hardware do from now on instead of working, by the names of mtr_fault_injection."""
        if isinstance(self.firmware, SimulatedFirmware):
            self.firmware.lift_is_stuck = parts.LIFT in faults
            self.firmware.servos_are_dead = parts.SERVOS in faults
        if self._port:
            self._port.fault = CAN_FAULTS.get(faults.get(parts.CAN, ""), Fault.NONE)

    def close(self) -> None:
        """Take the CAN adapter away, end the firmware, and close the truth's file."""
        self.firmware.close()
        if self._port:
            self._port.close()
        self._truth_log.close()
