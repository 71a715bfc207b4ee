"""ROS messages to the peripherals' plain data and back."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional, Union

import rospy
from sensor_msgs.msg import JointState

from mtr_core.crc import seal
from mtr_core.lockstep import clock
from mtr_core.problems import messages_of
from mtr_msgs.msg import (
    DesiredState,
    FirmwareCommand,
    FirmwareHealth,
    FirmwarePress,
    FirmwareState,
    PeripheralsState,
    PressReport,
    Problem,
    RobotMode,
)

from .core import Orders, Outcome
from .firmware import CALIBRATING, FirmwareOrder, FirmwareReport, PressState
from .firmware_clock import FirmwareClock, SharedClock
from .health_watch import Health
from .presses import PressOrder, PressResult

JOINTS = ("lift", "front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel")


def health_of(message: FirmwareHealth) -> Health:
    """The firmware's counters that a person may have to know of."""
    return Health(message.refused_commands, message.last_refusal, message.checksum_errors, message.skipped_frames,
                  message.calibration_copies)


def orders(desired: Optional[DesiredState], mode: Optional[RobotMode]) -> Orders:
    """What the other nodes want; None for one that is silent."""
    if desired is None:
        return Orders(mode=mode.mode) if mode else Orders()
    press = desired.press
    return Orders(
        session_id=desired.session_id, link_alive=desired.link_alive, stop=desired.stop,
        key_height_m=desired.key_height_m,
        press=PressOrder(desired.session_id, press.id, tuple(press.buttons), press.strength, press.duration_s),
        **({"mode": mode.mode, "has_goal": bool(mode.goal.id)} if mode else {}))


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


def press_message(order: FirmwareOrder) -> FirmwarePress:
    """One press, for the firmware."""
    return seal(FirmwarePress(id=order.id, servos=order.servos, strength=order.strength, hold_ms=order.hold_ms))


def state_message(outcome: Outcome, battery: float, stamp: rospy.Time) -> PeripheralsState:
    """State in the terms of the domain."""
    message = PeripheralsState(
        alive=outcome.alive, key_height_m=outcome.key_height_m, pressed_buttons=list(outcome.pressed_buttons),
        presses=[_press_report(result) for result in outcome.results], battery=battery, led=outcome.led_shown,
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


def _press_report(result: PressResult) -> PressReport:
    return PressReport(result.session_id, result.id, clock.stamp_of(result.start_ns), clock.stamp_of(result.end_ns),
                       result.error.text, messages_of(result.error, Problem))
