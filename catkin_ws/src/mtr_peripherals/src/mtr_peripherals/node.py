"""The peripherals' node: wires the topics to the core."""
# SPDX-License-Identifier: Apache-2.0
import threading
from dataclasses import replace
from typing import Any, Optional, Tuple

import rospy
from sensor_msgs.msg import BatteryState, JointState
from std_msgs.msg import Bool

from mtr_core import names, schedule
from mtr_core.crc import is_sound
from mtr_core.liveness import NS, is_fresh, steady_stamp_ns
from mtr_core.lockstep import ANY_NODE, PublisherWatch, Ticker, TickInput, clock, publisher, run_node
from mtr_core.lockstep.samples import Samples
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.quiet_log import QuietStart
from mtr_core.requests import PressReport
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import (
    DesiredState,
    DriveStatus,
    FirmwareCalibrate,
    FirmwareCommand,
    FirmwareHealth,
    FirmwareInputs,
    FirmwarePress,
    FirmwareSignals,
    FirmwareState,
    LiftCommand,
    MotionLock,
    PeripheralsState,
    RobotMode,
)

from . import problems
from .conversions import (
    battery_charge,
    emergency_word,
    firmware_report,
    health_of,
    inputs_from,
    inputs_report,
    joint_message,
    state_message,
)
from .core import STOPPED, Inputs, Outcome, Peripherals
from .emergency import EmergencyStops
from .firmware import SIGNAL_SILENT_S, FirmwareReport, InputsReport, is_stop
from .firmware_clock import FirmwareClock, RobotClock, SharedClock
from .health_watch import HealthWatch
from .key_lift import KeyLift
from .latest import Latest
from .orders import FirmwareOrders
from .parameters import Parameters

# Delay after which each report of emulated firmware has arrived: it reports every 40 ms, needs 10 ms on the line, and
# the simulator forwards it every 20 ms.
EMULATED_LAG_NS = 100_000_000
# The firmware's clock at power-on, at time 0 of a simulation: 2 minutes before it wraps, see its config.hpp.
EMULATED_CLOCK_START_US = 2 ** 32 - 1 - 120_000_000
# The manual controller publishes LiftCommand every 40 ms while its axis is deflected.
MANUAL_LIFT_SILENT_S = 0.2
# calibrate_lift repeats its order every 100 ms while it runs.
CALIBRATE_SILENT_S = 0.5
# Queue of motion locks; each owner publishes ten times a second.
LOCKS_QUEUED = 50


class PeripheralsNode:
    """Decides at each tick of its slot."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._core = Peripherals(parameters, KeyLift(described_robot().key()))
        start_us, lag_ns = (EMULATED_CLOCK_START_US, EMULATED_LAG_NS) if parameters.emulated_firmware else (0, 0)
        self._times = SharedClock(start_us) if clock.is_lockstep() else FirmwareClock()
        self._reports: Samples[FirmwareReport] = Samples(schedule.FIRMWARE, lag_ns, clock.is_lockstep())
        self._robot_clock, self._before = RobotClock(), clock.reading()
        self._battery: Latest[BatteryState] = Latest()
        self._manual_lift: Latest[LiftCommand] = Latest()
        self._calibrate: Latest[FirmwareCalibrate] = Latest()
        self._emergency = EmergencyStops(parameters.emergency_owners, parameters.emergency_silent_after_s)
        # Held from a decision to its last message; a stop in between is sent after them.
        self._deciding = threading.Lock()
        self._health = HealthWatch()
        self._start = QuietStart()
        self._logged: Optional[Tuple[Tuple[str, ...], Optional[PressReport], bool]] = None
        self._desired = TickInput(names.DESIRED_STATE, DesiredState, schedule.DISPATCHER)
        self._drive = TickInput(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL)
        self._board: Latest[InputsReport] = Latest()
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        command, press = (publisher(names.FIRMWARE_COMMAND, FirmwareCommand),
                          publisher(names.FIRMWARE_PRESS, FirmwarePress))
        signals = publisher(names.FIRMWARE_SIGNALS, FirmwareSignals)
        self._stop_input = publisher(names.STOP_INPUT, Bool) if parameters.stop_input else None
        self._orders = FirmwareOrders(self._times, lambda message: self._send(command, message),
                                      lambda message: self._send(press, message),
                                      lambda message: self._send(signals, message))
        self._state = publisher(names.PERIPHERALS_STATE, PeripheralsState)
        self._joints = publisher(names.JOINT_STATES, JointState)
        self._ticker = Ticker(schedule.PERIPHERALS)
        self._watch = PublisherWatch({
            **dict.fromkeys((names.DESIRED_STATE, names.ROBOT_MODE, names.MANUAL_LIFT, names.FIRMWARE_CALIBRATE,
                             names.FIRMWARE_STATE, names.FIRMWARE_INPUTS), ANY_NODE),
            **dict.fromkeys((names.FIRMWARE_COMMAND, names.FIRMWARE_PRESS, names.FIRMWARE_SIGNALS, names.STOP_INPUT),
                            rospy.get_name())})
        self._subscribers = (
            rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, self._take_state, queue_size=50, tcp_nodelay=True),
            rospy.Subscriber(names.FIRMWARE_INPUTS, FirmwareInputs, self._take_inputs, queue_size=10,
                             tcp_nodelay=True),
            rospy.Subscriber(names.FIRMWARE_HEALTH, FirmwareHealth, self._take_health, queue_size=1),
            rospy.Subscriber(names.FIRMWARE_CALIBRATE, FirmwareCalibrate, self._take_calibrate, queue_size=1),
            rospy.Subscriber(names.BATTERY, BatteryState, self._take_battery, queue_size=1),
            rospy.Subscriber(names.MANUAL_LIFT, LiftCommand, self._take_manual_lift, queue_size=1, tcp_nodelay=True),
            rospy.Subscriber(names.MOTION_LOCK, MotionLock, self._take_lock, queue_size=LOCKS_QUEUED,
                             tcp_nodelay=True))

    def spin(self) -> None:
        """Run until shutdown, then stop lift and servos at once instead of by the firmware's time-out."""
        rospy.on_shutdown(self._stop)
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        now_ns = clock.steady_at(tick)
        inputs = inputs_from(self._fresh(self._desired, tick), self._fresh(self._mode, tick))
        inputs = replace(inputs, manual_lift_mps=self._manual_lift_mps(now_ns), linear_mps=self._linear_mps(tick),
                         board=self._board.at(now_ns, SIGNAL_SILENT_S),
                         calibrates=self._calibrate.at(now_ns, CALIBRATE_SILENT_S) is not None)
        outcome = self._decide(inputs, self._reports.at(tick), now_ns)
        self._robot_clock.update(clock.reading())
        stamp = clock.stamp_of(tick)
        self._state.publish(state_message(outcome, self._charge(now_ns), stamp, self._robot_clock,
                                          self._times.restarts))
        self._joints.publish(joint_message(outcome, stamp))
        self._log(outcome)

    def _decide(self, inputs: Inputs, report: Optional[FirmwareReport], now_ns: int) -> Outcome:
        with self._deciding:
            stop = self._intrusion() or self._emergency.reason(now_ns)
            outcome = self._core.step(replace(inputs, emergency=stop), report, now_ns)
            self._orders.send(outcome, now_ns)
        return outcome

    def _intrusion(self) -> Problem:
        intruder = self._watch.intruder
        if intruder is None:
            return NO_PROBLEM
        return problems.EMERGENCY_STOP(cause=problems.SECOND_PUBLISHER(**intruder._asdict()))

    def _send(self, publisher: rospy.Publisher, message: object) -> None:
        publisher.publish(message)
        self._ticker.messages_sent += 1

    def _take_lock(self, message: MotionLock) -> None:
        with self._deciding:
            if self._emergency.take(emergency_word(message, self._steady_stamp_ns(message))):
                self._orders.send(STOPPED, clock.steady_ns())

    def _stop(self) -> None:
        with self._deciding:
            self._orders.end(clock.steady_ns())

    def _take_state(self, message: FirmwareState) -> None:
        if not is_sound(message):
            return
        stamp_ns = self._times.observe(message.time_us, clock.steady_ns())
        report = firmware_report(message, stamp_ns, self._times)
        self._reports.add(stamp_ns, report)
        self._reports.wait_until_wanted()

    def _take_inputs(self, message: FirmwareInputs) -> None:
        if not is_sound(message):
            return
        arrival_ns = clock.steady_ns()
        report = inputs_report(message, arrival_ns, self._times)
        self._board.take(report, report.stamp_ns)
        stop = is_stop(message.stop, (arrival_ns - report.stamp_ns) * NS)
        if self._stop_input and stop is not None:
            self._stop_input.publish(stop)

    def _take_health(self, message: FirmwareHealth) -> None:
        sentence = self._health.sentence(health_of(message), clock.steady_ns() * NS)
        if sentence:
            rospy.logwarn("%s", sentence)

    def _take_battery(self, message: BatteryState) -> None:
        self._battery.take(message, clock.steady_ns())

    def _take_manual_lift(self, message: LiftCommand) -> None:
        self._manual_lift.take(message, self._steady_stamp_ns(message))

    def _take_calibrate(self, message: FirmwareCalibrate) -> None:
        self._calibrate.take(message, clock.steady_ns())

    def _steady_stamp_ns(self, message: Any) -> int:
        now, before = clock.reading(), self._before
        self._before = now
        return steady_stamp_ns(message.header.stamp.to_nsec(), now, before)

    def _manual_lift_mps(self, now_ns: int) -> float:
        """Return the rate of the manual controller, or 0 if it commands none or is silent."""
        message = self._manual_lift.at(now_ns, MANUAL_LIFT_SILENT_S)
        return message.rate_mps if message else 0.0

    def _linear_mps(self, tick: int) -> float:
        """Return the velocity sent to the wheels, or 0 if drive control is silent."""
        drive = self._fresh(self._drive, tick)
        return drive.linear_mps if drive else 0.0

    def _charge(self, now_ns: int) -> float:
        message = self._battery.at(now_ns, self._parameters.battery_silent_after_s)
        return battery_charge(message.percentage if message else None)

    def _fresh(self, topic: TickInput, tick: int) -> Optional[Any]:
        message = topic.at(tick)
        return message if is_fresh(topic.age_s(tick), self._parameters.order_silent_after_s) else None

    def _log(self, outcome: Outcome) -> None:
        newest = outcome.results[-1] if outcome.results else None
        warns = self._start.warns(clock.steady_ns() * NS, is_good=not outcome.message)
        now = (outcome.message.kind, newest, warns and bool(outcome.message))
        if newest and self._logged and newest != self._logged[1]:
            rospy.loginfo("Press %d: %s", newest.id, newest.error or "done.")
        if outcome.message and (not self._logged or (now[0], now[2]) != (self._logged[0], self._logged[2])):
            log = rospy.logwarn if warns else rospy.loginfo
            log("%s", outcome.message)
        self._logged = now


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("peripherals", Parameters, PeripheralsNode)
