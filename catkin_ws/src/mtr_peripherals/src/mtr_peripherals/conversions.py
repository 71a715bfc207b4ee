"""ROS messages to the peripherals' plain data and back."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional, Union

import rospy
from sensor_msgs.msg import JointState

from mtr_core.conversions import desired_state_from
from mtr_core.crc import seal
from mtr_core.lockstep import clock
from mtr_core.problems import messages_of
from mtr_core.requests import PressReport
from mtr_msgs.msg import (
    DesiredState,
    FirmwareCommand,
    FirmwareHealth,
    FirmwarePress,
    FirmwareState,
    PeripheralsState,
    Problem,
    RobotMode,
)
from mtr_msgs.msg import PressReport as PressReportMessage

from .core import Inputs, Outcome
from .firmware import CALIBRATING, FirmwareReport, PressState, ServoPress
from .firmware_clock import FirmwareClock, SharedClock
from .health_watch import Health

JOINTS = ("lift", "front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel")


def health_of(message: FirmwareHealth) -> Health:
    """The firmware's counters that a person may have to know of."""
    return Health(message.refused_commands, message.last_refusal, message.checksum_errors, message.skipped_frames,
                  message.calibration_copies)


def inputs_from(desired: Optional[DesiredState], mode: Optional[RobotMode]) -> Inputs:
    """What the other nodes say; None for one that is silent."""
    if desired is None:
        return Inputs(mode=mode.mode) if mode else Inputs()
    wanted = desired_state_from(desired)
    return Inputs(wanted, mode.mode, bool(mode.goal.id)) if mode else Inputs(wanted)


def firmware_report(state: FirmwareState, stamp_ns: int, times: Union[FirmwareClock, SharedClock]) -> FirmwareReport:
    """A FirmwareState, sent at stamp_ns of the robot's clock."""
    started = state.press_state in (PressState.PRESSING.value, PressState.DONE.value)
    return FirmwareReport(
        stamp_ns=stamp_ns, lift_height_m=state.lift_height_m, press_id=state.press_id,
        press_state=PressState(state.press_state),
        press_start_ns=times.robot_ns(state.press_start_us, stamp_ns) if started else 0,
        press_end_ns=times.robot_ns(state.press_end_us, stamp_ns) if started else 0,
        led_pattern=state.led_pattern, fault=state.fault, is_calibrating=state.lift_state == CALIBRATING)


def command_message(outcome: Outcome, seq: int) -> FirmwareCommand:
    """Lift and LEDs, for the firmware."""
    return seal(FirmwareCommand(seq=seq % 2 ** 32, lift_height_m=outcome.lift_height_m, led_pattern=outcome.led.value))


def press_message(press: ServoPress) -> FirmwarePress:
    """One press, for the firmware."""
    return seal(FirmwarePress(id=press.id, servos=press.servos, strength=press.strength, hold_ms=press.hold_ms))


def state_message(outcome: Outcome, battery: float, stamp: rospy.Time) -> PeripheralsState:
    """State in the terms of the domain."""
    message = PeripheralsState(
        alive=outcome.alive, key_height_m=outcome.key_height_m, pressed_buttons=list(outcome.pressed_buttons),
        presses=[_report_message(report) for report in outcome.results], battery=battery, led=outcome.led_shown,
        message=outcome.message.text, problems=messages_of(outcome.message, Problem))
    message.header.stamp = stamp
    return message


def joint_message(outcome: Outcome, stamp: rospy.Time) -> JointState:
    """Joints for robot_state_publisher; the wheels' angles do not matter to anyone."""
    message = JointState(name=list(JOINTS), position=[outcome.lift_now_m] + [0.0] * (len(JOINTS) - 1))
    message.header.stamp = stamp
    return message


def battery_charge(percentage: Optional[float]) -> float:
    """0 to 1, NaN when unknown."""
    return percentage if percentage is not None and 0.0 <= percentage <= 1.0 else math.nan


def _report_message(report: PressReport) -> PressReportMessage:
    return PressReportMessage(report.session_id, report.id, clock.stamp_of(report.start_ns),
                              clock.stamp_of(report.end_ns), report.error.text, messages_of(report.error, Problem))
