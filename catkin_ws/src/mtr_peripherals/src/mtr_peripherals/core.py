"""The peripherals without ROS: orders and firmware reports in, firmware commands and state out."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Optional, Tuple

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.states import State

from . import problems
from .calibration import OrderRefused
from .firmware import FAULTS, FirmwareOrder, FirmwareReport, Led
from .parameters import Parameters
from .presses import Presses, PressOrder, PressResult

NS = 1e-9
# A person who holds the button wants the lift this far ahead; somewhat more than the period of the orders.
MANUAL_LEAD_S = 0.3


@dataclass(frozen=True)
class Orders:
    """What the other nodes want at a tick; the defaults are what holds when they are silent.

    Attributes:
        backs_unseen: the robot drives backwards, where no LiDAR looks.
        calibrates: a person's calibrate_lift is being heard.
    """

    session_id: int = 0
    link_alive: bool = False
    stop: bool = True
    key_height_m: float = math.nan
    press: PressOrder = PressOrder()
    mode: int = State.STARTING
    has_goal: bool = False
    manual_lift_mps: float = 0.0
    backs_unseen: bool = False
    calibrates: bool = False


@dataclass(frozen=True)
class Outcome:
    """What goes to the firmware (lift_height_m, led, press) and to the other nodes (the rest)."""

    lift_height_m: float
    led: Led
    press: Optional[FirmwareOrder]
    alive: bool
    lift_now_m: float
    key_height_m: float
    pressed_buttons: Tuple[int, ...]
    results: List[PressResult]
    led_shown: str
    message: Problem


class Peripherals:
    """Decides at each tick what lift, servos and LEDs do."""

    def __init__(self, parameters: Parameters):
        self._parameters, self._calibration = parameters, parameters.calibration
        self._presses = Presses(parameters.calibration)

    def step(self, orders: Orders, report: Optional[FirmwareReport], now_ns: int) -> Outcome:
        """Decide at one tick; report is the firmware's newest one."""
        silence = self._silence(report, now_ns)
        lift_height_m, refusal = self._lift(orders, report)
        # A press that has begun ends by itself; a new one needs a live link.
        press = self._presses.step(orders.press if orders.link_alive else PressOrder(), report, now_ns)
        fault = _fault(report) if report and not silence else NO_PROBLEM
        return Outcome(
            lift_height_m, self._led(orders, bool(silence or fault)), press, not silence,
            lift_now_m=report.lift_height_m if report else 0.0,
            key_height_m=self._calibration.key_height_m(report.lift_height_m) if report else math.nan,
            pressed_buttons=self._presses.pressed_buttons, results=list(self._presses.results),
            led_shown=_led_name(report), message=silence or fault or refusal)

    def _silence(self, report: Optional[FirmwareReport], now_ns: int) -> Problem:
        if report is None:
            return problems.FIRMWARE_NOT_REPORTED()
        age_s = (now_ns - report.stamp_ns) * NS
        if age_s > self._parameters.firmware_silent_after_s:
            return problems.FIRMWARE_SILENT(age_s=age_s)
        return NO_PROBLEM

    def _lift(self, orders: Orders, report: Optional[FirmwareReport]) -> Tuple[float, Problem]:
        if report is not None and (orders.calibrates or report.is_calibrating):
            return self._while_calibrating(orders, report)
        if orders.manual_lift_mps and report is not None:
            ahead_m = report.lift_height_m + MANUAL_LEAD_S * orders.manual_lift_mps
            return min(max(ahead_m, 0.0), self._calibration.lift_stroke_m), NO_PROBLEM
        if not orders.link_alive:
            return math.nan, NO_PROBLEM
        try:
            return self._calibration.lift_height_m(orders.key_height_m), NO_PROBLEM
        except OrderRefused as refused:
            return math.nan, refused.problem

    def _while_calibrating(self, orders: Orders, report: FirmwareReport) -> Tuple[float, Problem]:
        """Any height lets the firmware go on, NaN ends its calibration: the lift moves by itself then."""
        if orders.session_id or orders.manual_lift_mps:
            return math.nan, problems.CALIBRATION_REFUSED()
        if not orders.calibrates:
            return math.nan, problems.CALIBRATION_ENDED()
        return min(max(report.lift_height_m, 0.0), self._calibration.lift_stroke_m), NO_PROBLEM

    def _led(self, orders: Orders, failed: bool) -> Led:
        choices = (
            (Led.ERROR, failed or orders.mode == State.FAULT),
            (Led.STARTING, orders.mode == State.STARTING),
            (Led.LINK_LOST, bool(orders.session_id) and not orders.link_alive),
            (Led.WARNING, orders.backs_unseen),
            (Led.PRESSING, bool(self._presses.pressed_buttons)),
            (Led.PAUSED, bool(orders.session_id) and orders.stop),
            (Led.MAPPING, orders.mode == State.MAPPING_CAR),
            (Led.MOVING, orders.mode == State.FOLLOWING_WAYPOINT and orders.has_goal),
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
