"""Simulated devices without physics: the firmware of lift and servos, and the Car that detects the key; tick by
tick."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Mapping, Optional, Tuple

from mtr_core.schedule import CLOCK_STEP, SIMULATION_START_NS
from mtr_fault_injection import parts
from mtr_fault_injection.parts import Kind

from .car.can_port import CanPort
from .car.choice import Car, chosen_car
from .car.ecu import Command
from .car.slcan_port import Fault, SlcanPort
from .car.vehicle import MAX_SPEED_KMH
from .firmware.simulated import SimulatedFirmware
from .parameters import EquipmentParameters
from .truth.log import EventLog, NoTruthLog, TruthLog

CAN_FAULTS = {Kind.OFF.value: Fault.SILENCE, Kind.GARBAGE.value: Fault.GARBAGE, Kind.STOP.value: Fault.BUS_OFF}


class Equipment:
    """Firmware and Car; the physics engine's side provides the key's place.

    Attributes:
        firmware: firmware of the peripherals, simulated in this process or emulated.
        time_ns: time of the last tick.
    """

    def __init__(self, parameters: EquipmentParameters, firmware: Optional[Any] = None,
                 port: Optional[CanPort] = None):
        """port: receives the frames of the Car's bus instead of an adapter."""
        # The firmware's clock equals the simulated one; the clock of a real board starts anywhere.
        self.firmware = firmware or SimulatedFirmware(clock_start_us=SIMULATION_START_NS // 1000)
        self.time_ns = SIMULATION_START_NS
        self.firmware.start(self.time_ns)
        self._truth_log: EventLog = TruthLog(parameters.truth_dir) if parameters.truth_dir else NoTruthLog()
        self._port: Optional[SlcanPort] = None
        self._car: Optional[Car] = None
        if parameters.car_port_link:
            port = self._port = SlcanPort(parameters.car_port_link)
        if port:
            self._car = chosen_car(parameters.car).car(parameters.seed, port, self._truth_log)

    def begin_step(self) -> None:
        """Let an emulated firmware run in parallel until the caller calls step."""
        self.firmware.begin_step(self.time_ns + CLOCK_STEP.period_ns)

    def step(self) -> None:
        """Advance the firmware by 20 ms."""
        self.time_ns += CLOCK_STEP.period_ns
        self.firmware.step(self.time_ns)

    def see(self, key_in_car: Tuple[float, float, float], heading_rad: float) -> None:
        """Set the key's place at this tick, in frame car (m, z above ground), and its heading there."""
        if self._car:
            self._car.step(self.time_ns, key_in_car, self.firmware.servo_us, heading_rad)

    def request_handle(self, locks: bool) -> None:
        """Simulate a hand that pulls the Car's handle, to lock or to open it."""
        if self._car:
            self._car.request_handle(Command.LOCK if locks else Command.UNLOCK)

    def set_ignition(self, is_on: bool) -> None:
        """Set the ignition that the Car reports."""
        if self._car:
            self._car.vehicle.ignition_on = is_on

    def set_car_speed(self, speed_kmh: float) -> None:
        """Set the speed that the Car reports while it is stopped; the value is limited to its range."""
        if self._car and math.isfinite(speed_kmh):
            self._car.vehicle.speed_kmh = min(max(speed_kmh, 0.0), MAX_SPEED_KMH)

    def set_faults(self, faults: Mapping[str, str]) -> None:
        """Set the faults of the hardware's parts, by the names of mtr_fault_injection."""
        if isinstance(self.firmware, SimulatedFirmware):
            self.firmware.lift_is_stuck = parts.LIFT in faults
            self.firmware.servos_are_dead = parts.SERVOS in faults
        if self._port:
            self._port.fault = CAN_FAULTS.get(faults.get(parts.CAN, ""), Fault.NONE)

    def close(self) -> None:
        """Remove the CAN adapter, end the firmware, and close the truth's file."""
        self.firmware.close()
        if self._port:
            self._port.close()
        self._truth_log.close()
