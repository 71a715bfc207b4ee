"""Messages to and from the firmware as plain data, and the meaning of its inputs and signals."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass
from typing import Optional

from mtr_core.liveness import NS, is_fresh

from . import problems


class PressState(enum.Enum):
    """State of a press as reported by the firmware, with the values of FirmwareState."""

    NONE = 0
    PRESSING = 1
    DONE = 2
    REFUSED = 3
    CUT_SHORT = 4


class Led(enum.Enum):
    """Patterns of the LEDs, with the values of FirmwareCommand."""

    OFF = 0
    STARTING = 1
    READY = 2
    MAPPING = 3
    MOVING = 4
    PRESSING = 5
    PAUSED = 6
    ERROR = 7
    LINK_LOST = 8
    WARNING = 9
    SETS_OFF = 10


class Signal(enum.Enum):
    """Warning signals, with the values of FirmwareSignals."""

    NONE = 0
    SETS_OFF = 1
    REVERSES = 2


class StopInput(enum.Enum):
    """State of the board's stop input, with the values of FirmwareInputs."""

    UNUSED = 0
    CLOSED = 1
    OPEN = 2


# Values of FirmwareState.fault.
GIVEN_UP = 4
FAULTS = {1: problems.LIFT_JAMMED, 2: problems.LIFT_SENSOR_BROKEN, 3: problems.NO_COMMANDS,
          GIVEN_UP: problems.LIFT_GAVE_UP}

# Value of FirmwareState.lift_state.
CALIBRATING = 2

# FirmwareInputs arrive every 80 ms.
SIGNAL_SILENT_S = 0.5
# A later report of a closed input is ignored; drive control then treats the topic as silent after 0.25 s.
STOP_LATE_S = 0.15


@dataclass(frozen=True)
class FirmwareReport:
    """One FirmwareState with its times on the steady clock, in ns."""

    stamp_ns: int
    lift_height_m: float = 0.0
    press_id: int = 0
    press_state: PressState = PressState.NONE
    press_start_ns: int = 0
    press_end_ns: int = 0
    led_pattern: int = 0
    fault: int = 0
    is_calibrating: bool = False


@dataclass(frozen=True)
class InputsReport:
    """One FirmwareInputs with its time on the steady clock, in ns."""

    stamp_ns: int
    signal: int = Signal.NONE.value


@dataclass(frozen=True)
class SignalOrder:
    """Warning signals for the firmware, and whether a stop chain is connected to it."""

    signal: Signal = Signal.NONE
    has_beacon: bool = False
    uses_stop_input: bool = False


@dataclass(frozen=True)
class ServoPress:
    """One press for the firmware: servos are bits; it must not begin after latest_ns of the steady clock."""

    id: int
    servos: int
    strength: float
    hold_ms: int
    latest_ns: int


def signal_order(sets_off: bool, linear_mps: float, is_controlled: bool, uses_stop_input: bool) -> SignalOrder:
    """Return the signals at a tick.

    linear_mps: velocity sent to the wheels. is_controlled: an application controls the robot, which may move at any
    time and therefore shows its beacon.
    """
    signal = Signal.SETS_OFF if sets_off else Signal.REVERSES if linear_mps < 0.0 else Signal.NONE
    has_beacon = sets_off or is_controlled or linear_mps != 0.0
    return SignalOrder(signal, has_beacon, uses_stop_input)


def given_signal(report: Optional[InputsReport], now_ns: int) -> int:
    """Return the signal that the board reports as given, or NONE if it is silent."""
    if report is None or not is_fresh((now_ns - report.stamp_ns) * NS, SIGNAL_SILENT_S):
        return Signal.NONE.value
    return report.signal


def is_stop(state: int, age_s: float) -> Optional[bool]:
    """Return whether a report of the stop input means stop: any state but closed does at any age.

    None for a delayed report of a closed input, because it does not state the current position.
    """
    if state != StopInput.CLOSED.value:
        return True
    return False if is_fresh(age_s, STOP_LATE_S) else None
