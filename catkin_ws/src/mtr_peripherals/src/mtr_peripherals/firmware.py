"""What passes between this package and the firmware, as plain data."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass

from . import problems


class PressState(enum.Enum):
    """What the firmware says of a press; the values are those of FirmwareState."""

    NONE = 0
    PRESSING = 1
    DONE = 2
    REFUSED = 3
    CUT_SHORT = 4


class Led(enum.Enum):
    """Patterns of the LEDs; the values are those of FirmwareCommand."""

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
    """Warning signals; the values are those of FirmwareSignals."""

    NONE = 0
    SETS_OFF = 1
    REVERSES = 2


class StopInput(enum.Enum):
    """State of the board's stop input; the values are those of FirmwareInputs."""

    UNUSED = 0
    CLOSED = 1
    OPEN = 2


# Of FirmwareState.fault.
GIVEN_UP = 4
FAULTS = {1: problems.LIFT_JAMMED, 2: problems.LIFT_SENSOR_BROKEN, 3: problems.NO_COMMANDS,
          GIVEN_UP: problems.LIFT_GAVE_UP}

# Of FirmwareState.lift_state.
CALIBRATING = 2


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
