"""The peripherals' node: wires the topics to the core."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Any, Optional, Tuple

import rospy
from sensor_msgs.msg import BatteryState, JointState

from mtr_core import names, schedule
from mtr_core.crc import is_sound
from mtr_core.lockstep import Ticker, TickInput, clock, publisher, run_node
from mtr_core.lockstep.samples import Samples
from mtr_core.requests import PressReport
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import (
    DesiredState,
    DriveStatus,
    FirmwareCalibrate,
    FirmwareCommand,
    FirmwareHealth,
    FirmwarePress,
    FirmwareState,
    LiftCommand,
    PeripheralsState,
    RobotMode,
)

from .conversions import (
    battery_charge,
    command_message,
    firmware_report,
    health_of,
    inputs_from,
    joint_message,
    press_message,
    state_message,
)
from .core import Outcome, Peripherals
from .firmware import FirmwareReport
from .firmware_clock import FirmwareClock, SharedClock
from .health_watch import HealthWatch
from .key_lift import KeyLift
from .parameters import Parameters

NS = 1e-9
# Each report of emulated firmware is there by then: it reports every 40 ms, needs 10 ms on the line, and the simulator
# hands on every 20 ms.
EMULATED_LAG_NS = 100_000_000
# The firmware's clock when it is powered on, at time 0 of a simulation: 2 minutes before it wraps, see its config.hpp.
EMULATED_CLOCK_START_US = 2 ** 32 - 1 - 120_000_000
# It speaks every 40 ms while the person wants it, as LiftCommand says.
MANUAL_LIFT_SILENT_S = 0.2
# calibrate_lift repeats its order every 100 ms as long as the person lets it run.
CALIBRATE_SILENT_S = 0.5


class PeripheralsNode:
    """Decides at each tick of its slot."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._core = Peripherals(parameters, KeyLift(described_robot().key()))
        start_us, lag_ns = (EMULATED_CLOCK_START_US, EMULATED_LAG_NS) if parameters.emulated_firmware else (0, 0)
        self._times = SharedClock(start_us) if clock.is_simulated() else FirmwareClock()
        self._reports: Samples[FirmwareReport] = Samples(schedule.FIRMWARE, lag_ns, clock.is_simulated())
        self._battery: Tuple[int, Optional[float]] = (0, None)
        self._manual_lift = LiftCommand()
        self._calibrate_ns: Optional[int] = None
        self._health = HealthWatch()
        self._seq = 0
        self._logged: Optional[Tuple[str, Optional[PressReport]]] = None
        self._desired = TickInput(names.DESIRED_STATE, DesiredState, schedule.DISPATCHER)
        # Lock-step waits for each input, so only for what is needed.
        self._drive = None if parameters.rear_lidar else TickInput(names.DRIVE_STATUS, DriveStatus,
                                                                   schedule.DRIVE_CONTROL)
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        self._command = publisher(names.FIRMWARE_COMMAND, FirmwareCommand)
        self._press = publisher(names.FIRMWARE_PRESS, FirmwarePress)
        self._state = publisher(names.PERIPHERALS_STATE, PeripheralsState)
        self._joints = publisher(names.JOINT_STATES, JointState)
        self._subscribers = (
            rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, self._take_state, queue_size=50, tcp_nodelay=True),
            rospy.Subscriber(names.FIRMWARE_HEALTH, FirmwareHealth, self._take_health, queue_size=1),
            rospy.Subscriber(names.FIRMWARE_CALIBRATE, FirmwareCalibrate, self._take_calibrate, queue_size=1),
            rospy.Subscriber(names.BATTERY, BatteryState, self._take_battery, queue_size=1),
            rospy.Subscriber(names.MANUAL_LIFT, LiftCommand, self._take_manual_lift, queue_size=1, tcp_nodelay=True))
        self._ticker = Ticker(schedule.PERIPHERALS)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        inputs = inputs_from(self._fresh(self._desired.at(tick), tick), self._fresh(self._mode.at(tick), tick))
        inputs = replace(inputs, manual_lift_mps=self._manual_lift_mps(tick), backs_unseen=self._backs_unseen(tick),
                         calibrates=self._calibrates(tick))
        outcome = self._core.step(inputs, self._reports.at(tick), tick)
        self._seq += 1
        self._send(self._command, command_message(outcome, self._seq))
        if outcome.press:
            self._send(self._press, press_message(outcome.press))
        stamp = clock.stamp_of(tick)
        self._state.publish(state_message(outcome, self._charge(tick), stamp))
        self._joints.publish(joint_message(outcome, stamp))
        self._log(outcome)

    def _send(self, publisher: rospy.Publisher, message: object) -> None:
        publisher.publish(message)
        self._ticker.messages_sent += 1

    def _take_state(self, message: FirmwareState) -> None:
        if not is_sound(message):
            return
        stamp_ns = self._times.observe(message.time_us, clock.now_ns())
        report = firmware_report(message, stamp_ns, self._times)
        self._reports.add(stamp_ns, report)
        self._reports.wait_until_wanted()

    def _take_health(self, message: FirmwareHealth) -> None:
        sentence = self._health.sentence(health_of(message), clock.now_ns() * NS)
        if sentence:
            rospy.logwarn("%s", sentence)

    def _take_battery(self, message: BatteryState) -> None:
        self._battery = (clock.now_ns(), message.percentage)

    def _take_manual_lift(self, message: LiftCommand) -> None:
        self._manual_lift = message

    def _take_calibrate(self, _message: FirmwareCalibrate) -> None:
        self._calibrate_ns = clock.now_ns()

    def _calibrates(self, tick: int) -> bool:
        return self._calibrate_ns is not None and (tick - self._calibrate_ns) * NS <= CALIBRATE_SILENT_S

    def _manual_lift_mps(self, tick: int) -> float:
        """Rate wanted by the manual controller, 0 when it wants nothing or is silent."""
        age_s = (tick - self._manual_lift.header.stamp.to_nsec()) * NS
        return self._manual_lift.rate_mps if age_s <= MANUAL_LIFT_SILENT_S else 0.0

    def _backs_unseen(self, tick: int) -> bool:
        drive = self._fresh(self._drive.at(tick), tick) if self._drive else None
        return drive is not None and drive.linear_mps < 0.0

    def _charge(self, tick: int) -> float:
        taken_ns, percentage = self._battery
        stale = (tick - taken_ns) * NS > self._parameters.battery_silent_after_s
        return battery_charge(None if stale else percentage)

    def _fresh(self, message: Optional[Any], tick: int) -> Optional[Any]:
        if message is None or (tick - message.header.stamp.to_nsec()) * NS > self._parameters.order_silent_after_s:
            return None
        return message

    def _log(self, outcome: Outcome) -> None:
        newest = outcome.results[-1] if outcome.results else None
        now = (outcome.message.text.split(" for ")[0], newest)
        if newest and self._logged and newest != self._logged[1]:
            rospy.loginfo("Press %d: %s", newest.id, newest.error or "done.")
        if outcome.message and (not self._logged or now[0] != self._logged[0]):
            rospy.logwarn("%s", outcome.message)
        self._logged = now


def main() -> int:
    """Run the node; its exit status."""
    return run_node("peripherals", Parameters, PeripheralsNode)
