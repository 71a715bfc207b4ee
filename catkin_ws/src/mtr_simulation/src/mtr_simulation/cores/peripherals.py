"""The peripherals between their core, the firmware and the other parts, as mtr_peripherals' node."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Any, Optional

from mtr_core.liveness import Instant
from mtr_core.schedule import FIRMWARE, PERIPHERALS, slot
from mtr_description.mounts import KeyMount
from mtr_peripherals.conversions import battery_charge, firmware_report, inputs_from, state_message
from mtr_peripherals.core import Peripherals
from mtr_peripherals.emergency import EmergencyStops
from mtr_peripherals.firmware import InputsReport
from mtr_peripherals.firmware_clock import RobotClock, SharedClock
from mtr_peripherals.key_lift import KeyLift
from mtr_peripherals.orders import FirmwareOrders
from mtr_peripherals.parameters import Parameters
from mtr_simulation.firmware.simulated import SimulatedFirmware
from mtr_simulation.sensors.readings import Sensors

from . import wire
from .topics import Topic, Topics

_BATTERY = slot(1000)


class PeripheralsPart:
    """Decides at each tick of its slot."""

    slot = PERIPHERALS

    def __init__(self, topics: Topics, parameters: Parameters, key: KeyMount, firmware: SimulatedFirmware):
        self._core, self._parameters = Peripherals(parameters, KeyLift(key)), parameters
        self._topics, self._firmware = topics, firmware
        self._times, self._robot_clock = SharedClock(), RobotClock()
        self._orders = FirmwareOrders(self._times, self._command, self._press, self._signals)
        self._reports = Topic()
        self._emergency = EmergencyStops(parameters.emergency_owners, parameters.emergency_silent_after_s)
        self._charge: Optional[float] = None
        self._board: Optional[InputsReport] = None
        self._desired, self._mode, self._drive = topics.desired.input(), topics.mode.input(), topics.drive.input()

    def sense(self, sensors: Sensors) -> None:
        """What firmware and battery say at this tick."""
        if _BATTERY.last_at(sensors.time_ns) == sensors.time_ns:
            self._charge = wire.single(sensors.battery.charge)
        if FIRMWARE.last_at(sensors.time_ns) == sensors.time_ns:
            state = self._firmware.state()
            stamp_ns = self._times.observe(state.time_us, sensors.time_ns)
            report = firmware_report(state, stamp_ns, self._times)
            self._reports.add(stamp_ns, replace(report, lift_height_m=wire.single(report.lift_height_m)))
            board = self._firmware.input_state()
            self._board = InputsReport(self._times.steady_ns(board.time_us, sensors.time_ns), board.signal)

    def step(self, tick_ns: int) -> None:
        """One tick."""
        limit_s = self._parameters.order_silent_after_s
        inputs = inputs_from(self._desired.fresh_at(tick_ns, limit_s), self._mode.fresh_at(tick_ns, limit_s))
        drive = self._drive.fresh_at(tick_ns, limit_s)
        inputs = replace(inputs, emergency=self._emergency.reason(tick_ns), board=self._board,
                         linear_mps=drive.linear_mps if drive else 0.0)
        outcome = self._core.step(inputs, self._reports.until(tick_ns), tick_ns)
        self._orders.send(outcome, tick_ns)
        self._robot_clock.update(Instant(tick_ns, tick_ns))
        self._topics.peripherals.publish(state_message(outcome, battery_charge(self._charge), wire.stamp(tick_ns),
                                                       self._robot_clock, self._times.restarts))

    def _command(self, message: Any) -> None:
        self._firmware.command(wire.single(message.lift_height_m), message.led_pattern, bool(message.stop),
                               message.latest_us)

    def _signals(self, message: Any) -> None:
        self._firmware.signals(message.signal, bool(message.beacon), bool(message.stop_input), message.latest_us)

    def _press(self, message: Any) -> None:
        self._firmware.press(message.id, message.servos, wire.single(message.strength), message.hold_ms,
                             message.latest_us)
