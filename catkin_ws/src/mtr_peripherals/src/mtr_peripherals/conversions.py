"""Converts ROS messages to the peripherals' plain data and back."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional, Union

from genpy import Time
from sensor_msgs.msg import JointState

from mtr_core.conversions import desired_state_from, stamp_of
from mtr_core.crc import seal
from mtr_core.problems import NO_PROBLEM, messages_of, problem_of
from mtr_core.requests import PressReport
from mtr_msgs.msg import (
    DesiredState,
    FirmwareCommand,
    FirmwareHealth,
    FirmwareInputs,
    FirmwarePress,
    FirmwareSignals,
    FirmwareState,
    MotionLock,
    PeripheralsState,
    Problem,
    RobotMode,
)
from mtr_msgs.msg import PressReport as PressReportMessage

from . import problems
from .core import Inputs, Outcome
from .emergency import EmergencyWord
from .firmware import CALIBRATING, FirmwareReport, InputsReport, PressState, ServoPress, SignalOrder
from .firmware_clock import FirmwareClock, RobotClock, SharedClock
from .health_watch import Health

FirmwareTimes = Union[FirmwareClock, SharedClock]
JOINTS = ("lift", "front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel")


def health_of(message: FirmwareHealth) -> Health:
    """Return the firmware's counters that may be reported to the Operator."""
    return Health(message.refused_commands, message.last_refusal, message.checksum_errors, message.skipped_frames,
                  message.calibration_copies, message.resets, message.reset_cause)


def inputs_from(desired: Optional[DesiredState], mode: Optional[RobotMode]) -> Inputs:
    """Return the inputs from the other nodes; None for a silent node."""
    if desired is None:
        return Inputs(mode=mode.mode) if mode else Inputs()
    wanted = desired_state_from(desired)
    if mode is None:
        return Inputs(wanted)
    return Inputs(wanted, mode.mode, bool(mode.goal.id), bool(mode.hold_id), sets_off=mode.sets_off)


def firmware_report(state: FirmwareState, stamp_ns: int, times: FirmwareTimes) -> FirmwareReport:
    """Return a FirmwareState that was sent at stamp_ns of the steady clock."""
    started = state.press_state in (PressState.PRESSING.value, PressState.DONE.value)
    return FirmwareReport(
        stamp_ns=stamp_ns, lift_height_m=state.lift_height_m, press_id=state.press_id,
        press_state=PressState(state.press_state),
        press_start_ns=times.steady_ns(state.press_start_us, stamp_ns) if started else 0,
        press_end_ns=times.steady_ns(state.press_end_us, stamp_ns) if started else 0,
        led_pattern=state.led_pattern, fault=state.fault, is_calibrating=state.lift_state == CALIBRATING)


def inputs_report(message: FirmwareInputs, arrival_ns: int, times: FirmwareTimes) -> InputsReport:
    """Return a FirmwareInputs that arrived at a time of the steady clock."""
    return InputsReport(times.steady_ns(message.time_us, arrival_ns), message.signal)


def signals_message(order: SignalOrder, latest_us: int) -> FirmwareSignals:
    """Return the warning signals for the firmware, valid until latest_us of its clock."""
    return seal(FirmwareSignals(signal=order.signal.value, beacon=order.has_beacon, stop_input=order.uses_stop_input,
                                latest_us=latest_us))


def command_message(outcome: Outcome, seq: int, latest_us: int) -> FirmwareCommand:
    """Return the command for lift and LEDs, valid until latest_us of the firmware's clock."""
    return seal(FirmwareCommand(seq=seq % 2 ** 32, lift_height_m=outcome.lift_height_m, led_pattern=outcome.led.value,
                                stop=outcome.stop, latest_us=latest_us))


def press_message(press: ServoPress, latest_us: int) -> FirmwarePress:
    """Return the order for one press, which the firmware does not start after latest_us of its clock."""
    return seal(FirmwarePress(id=press.id, servos=press.servos, strength=press.strength, hold_ms=press.hold_ms,
                              latest_us=latest_us))


def emergency_word(message: MotionLock, steady_stamp_ns: int) -> EmergencyWord:
    """Return the emergency stop in the motion lock of its owner."""
    reason = problem_of(message.problems, message.reason) or problems.EMERGENCY_ENGAGED(owner=message.owner)
    return EmergencyWord(message.owner, reason if message.engaged else NO_PROBLEM, steady_stamp_ns, message.emergency)


def state_message(outcome: Outcome, battery: float, stamp: Time, clock_of_robot: RobotClock,
                  firmware_resets: int) -> PeripheralsState:
    """Return the state of the peripherals in domain terms."""
    message = PeripheralsState(
        alive=outcome.alive, key_height_m=outcome.key_height_m, pressed_buttons=list(outcome.pressed_buttons),
        presses=[_report_message(report, clock_of_robot) for report in outcome.results], battery=battery,
        led=outcome.led_shown, message=outcome.message.text, problems=messages_of(outcome.message, Problem),
        manual_lifts=outcome.manual_lifts, firmware_resets=firmware_resets, lift_jams=outcome.lift_jams,
        signal=outcome.signal_given)
    message.header.stamp = stamp
    return message


def joint_message(outcome: Outcome, stamp: Time) -> JointState:
    """Return the joints for robot_state_publisher; the wheels' angles are not used."""
    message = JointState(name=list(JOINTS), position=[outcome.lift_now_m] + [0.0] * (len(JOINTS) - 1))
    message.header.stamp = stamp
    return message


def battery_charge(percentage: Optional[float]) -> float:
    """Return the charge from 0 to 1, or NaN if it is unknown."""
    return percentage if percentage is not None and 0.0 <= percentage <= 1.0 else math.nan


def _report_message(report: PressReport, clock_of_robot: RobotClock) -> PressReportMessage:
    start, end = (stamp_of(clock_of_robot.robot_ns(at_ns)) for at_ns in (report.start_ns, report.end_ns))
    return PressReportMessage(report.session_id, report.id, start, end, report.error.text,
                              messages_of(report.error, Problem))
