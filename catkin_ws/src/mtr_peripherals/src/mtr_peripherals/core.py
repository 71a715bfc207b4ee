"""The peripherals without ROS: requests and firmware reports in, firmware commands and state out."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Optional, Tuple

from mtr_core.liveness import is_fresh
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_PRESS, DesiredState, PressReport
from mtr_core.schedule import DRIVE_CONTROL, PERIPHERALS, STATE_MACHINE
from mtr_core.states import State

from . import problems
from .calibration import RequestRefused
from .firmware import (
    FAULTS,
    GIVEN_UP,
    FirmwareReport,
    InputsReport,
    Led,
    ServoPress,
    Signal,
    SignalOrder,
    given_signal,
    signal_order,
)
from .key_lift import KeyLift
from .parameters import Parameters
from .presses import Presses

NS = 1e-9
# Time from a lock until the wheels brake, as in drive control's `reaction_s` without its tick.
WHEELS_ANSWER_S = 0.06
# Neither this node nor the state machine, which stops the robot, nor drive control detects a silence between two ticks.
# So it is reported this long before its limit, and the wheels brake when the limit is reached.
TOLD_BEFORE_S = (PERIPHERALS.period_ns + STATE_MACHINE.period_ns + DRIVE_CONTROL.period_ns) * NS + WHEELS_ANSWER_S
# Distance in s of the manual target ahead of the lift; somewhat more than the period of the controller's messages.
MANUAL_LEAD_S = 0.3
# States of a faulty part, or of an unknown state of the robot.
UNWELL_STATES = (State.STARTING, State.FAULT)


@dataclass(frozen=True)
class Inputs:
    """Inputs from the other nodes at a tick; the defaults apply while they are silent.

    Attributes:
        mode: state of the robot.
        has_goal: the robot drives to a goal.
        is_held: the robot is on hold until the Operator resumes it; a person may be at the mast.
        manual_lift_mps: rate commanded by the manual controller, upwards positive; 0: none.
        linear_mps: velocity sent to the wheels, negative backwards.
        sets_off: the state machine waits for the signal before motion.
        board: newest report of the board's inputs and signals.
        calibrates: calibrate_lift repeats its request.
        emergency: why an emergency stop is engaged, no problem if none is.
    """

    desired: DesiredState = DesiredState()
    mode: int = State.STARTING
    has_goal: bool = False
    is_held: bool = False
    manual_lift_mps: float = 0.0
    linear_mps: float = 0.0
    sets_off: bool = False
    board: Optional[InputsReport] = None
    calibrates: bool = False
    emergency: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Outcome:
    """Outputs for the firmware (stop, lift_height_m, led, press) and for the other nodes (the rest).

    Times are of the steady clock.

    Attributes:
        stop: the firmware holds the lift, releases the servos and starts no press.
        manual_lifts: number of times that the manual controller started to move the lift.
        signals: for the firmware; None leaves the signals in force.
        signal_given: number of the signal that the board reports.
        lift_jams: number of times that the lift gave up after a jam.
    """

    stop: bool
    lift_height_m: float
    led: Led
    press: Optional[ServoPress]
    alive: bool
    lift_now_m: float
    key_height_m: float
    pressed_buttons: Tuple[int, ...]
    results: List[PressReport]
    led_shown: str
    message: Problem
    manual_lifts: int
    signals: Optional[SignalOrder] = None
    signal_given: int = Signal.NONE.value
    lift_jams: int = 0


# Order to the firmware when an emergency stop is engaged between two ticks.
STOPPED = Outcome(stop=True, lift_height_m=math.nan, led=Led.PAUSED, press=None, alive=False, lift_now_m=0.0,
                  key_height_m=math.nan, pressed_buttons=(), results=[], led_shown="", message=NO_PROBLEM,
                  manual_lifts=0)


class Peripherals:
    """Controls lift, servos and LEDs at each tick."""

    def __init__(self, parameters: Parameters, lift: KeyLift):
        self._parameters, self._key_lift = parameters, lift
        self._presses = Presses(parameters.calibration)
        self._manual_lifts = self._lift_jams = 0
        self._has_given_up = False
        self._is_manual = False

    def step(self, inputs: Inputs, report: Optional[FirmwareReport], now_ns: int) -> Outcome:
        """Decide at now_ns of the steady clock; report is the firmware's newest."""
        silence = self._silence(report, now_ns)
        lift_height_m, refusal = self._lift(inputs, report) if not silence else (math.nan, NO_PROBLEM)
        press = self._press(inputs, report, now_ns)
        self._count_manual_lift(inputs)
        self._count_jam(report)
        fault = _fault(report) if report and not silence else NO_PROBLEM
        return Outcome(
            bool(inputs.emergency), lift_height_m, self._led(inputs, bool(silence or fault)), press, not silence,
            lift_now_m=report.lift_height_m if report else 0.0,
            key_height_m=self._key_lift.key_height_m(report.lift_height_m) if report else math.nan,
            pressed_buttons=self._presses.pressed_buttons, results=list(self._presses.results),
            led_shown=_led_name(report), message=silence or fault or inputs.emergency or refusal,
            manual_lifts=self._manual_lifts, lift_jams=self._lift_jams,
            signals=signal_order(inputs.sets_off, inputs.linear_mps, bool(inputs.desired.session_id),
                                 self._parameters.stop_input),
            signal_given=given_signal(inputs.board, now_ns))

    def _silence(self, report: Optional[FirmwareReport], now_ns: int) -> Problem:
        if report is None:
            return problems.FIRMWARE_NOT_REPORTED()
        age_s = (now_ns - report.stamp_ns) * NS
        if not is_fresh(age_s, self._parameters.firmware_silent_after_s - TOLD_BEFORE_S):
            return problems.FIRMWARE_SILENT(age_s=age_s)
        return NO_PROBLEM

    def _press(self, inputs: Inputs, report: Optional[FirmwareReport], now_ns: int) -> Optional[ServoPress]:
        desired = inputs.desired
        if desired.session_id:
            self._presses.take_up(desired.press, report, now_ns)
        is_stopped = desired.stop or inputs.is_held or inputs.mode in UNWELL_STATES
        stop = inputs.emergency or (problems.STOPPED() if is_stopped else NO_PROBLEM)
        # A started press ends by itself; a new one requires a live link.
        return self._presses.step(desired.press if desired.link_alive else NO_PRESS, report, now_ns, stop)

    def _count_manual_lift(self, inputs: Inputs) -> None:
        is_manual = bool(inputs.manual_lift_mps)
        self._manual_lifts += is_manual and not self._is_manual
        self._is_manual = is_manual

    def _count_jam(self, report: Optional[FirmwareReport]) -> None:
        has_given_up = report is not None and report.fault == GIVEN_UP
        self._lift_jams += has_given_up and not self._has_given_up
        self._has_given_up = has_given_up

    def _lift(self, inputs: Inputs, report: Optional[FirmwareReport]) -> Tuple[float, Problem]:
        if inputs.emergency:
            return math.nan, NO_PROBLEM
        if report is not None and (inputs.calibrates or report.is_calibrating):
            return self._while_calibrating(inputs, report)
        if inputs.manual_lift_mps and report is not None:
            ahead_m = report.lift_height_m + MANUAL_LEAD_S * inputs.manual_lift_mps
            return self._key_lift.within_travel_m(ahead_m), NO_PROBLEM
        if not inputs.desired.link_alive or inputs.desired.stop or inputs.is_held or inputs.mode in UNWELL_STATES:
            return math.nan, NO_PROBLEM
        try:
            return self._key_lift.height_m(inputs.desired.key_height_m), NO_PROBLEM
        except RequestRefused as refused:
            return math.nan, refused.problem

    def _while_calibrating(self, inputs: Inputs, report: FirmwareReport) -> Tuple[float, Problem]:
        """Return a valid height, which lets the firmware continue to calibrate, or NaN, which aborts it."""
        if inputs.desired.session_id or inputs.manual_lift_mps:
            return math.nan, problems.CALIBRATION_REFUSED()
        if not inputs.calibrates:
            return math.nan, problems.CALIBRATION_ENDED()
        return self._key_lift.within_travel_m(report.lift_height_m), NO_PROBLEM

    def _led(self, inputs: Inputs, failed: bool) -> Led:
        choices = (
            (Led.ERROR, failed or inputs.mode == State.FAULT),
            (Led.STARTING, inputs.mode == State.STARTING),
            (Led.LINK_LOST, bool(inputs.desired.session_id) and not inputs.desired.link_alive),
            (Led.SETS_OFF, inputs.sets_off),
            (Led.WARNING, inputs.linear_mps < 0.0),
            (Led.PRESSING, bool(self._presses.pressed_buttons)),
            (Led.PAUSED, bool(inputs.desired.session_id) and inputs.desired.stop),
            (Led.MAPPING, inputs.mode == State.MAPPING_CAR),
            (Led.MOVING, inputs.mode == State.FOLLOWING_WAYPOINT and inputs.has_goal),
        )
        return next((led for led, holds in choices if holds), Led.READY)


def _fault(report: FirmwareReport) -> Problem:
    if not report.fault:
        return NO_PROBLEM
    known = FAULTS.get(report.fault)
    return known() if known else problems.OTHER_FAULT(fault=report.fault)


def _led_name(report: Optional[FirmwareReport]) -> str:
    known = {led.value: led.name.lower() for led in Led}
    return known.get(report.led_pattern, "unknown") if report else "unknown"
