"""Calibration of lift and servos: the only place where metres above ground and servos meet heights and buttons."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Iterable, Sequence

from mtr_core.errors import ConfigurationError, RobotError, check_range

MAX_SERVOS = 2
MAX_BUTTON = 255
# Rounding of a height that was sent as a 32-bit float.
HEIGHT_ROUNDING_M = 1e-3


class OrderRefused(RobotError):
    """The lift or a servo cannot do what is asked."""


@dataclass(frozen=True)
class Calibration:
    """What config/calibration.yaml says.

    Attributes:
        key_height_at_lower_stop_m: Remote key above ground with the lift at its lower stop, 0.05 to 1.5 m.
        lift_stroke_m: travel of the lift, 0.05 to 2 m.
        button_of_servo: number of the button that each servo presses, in the firmware's order; 1 or 2 servos.
        minimum_strength, maximum_strength: allowed travel of a press, 0 to 1.
        default_hold_s: time a button is held when the order names none, 0.05 to 10 s.
        maximum_hold_s: longest time a button is held, 0.05 to 60 s (the firmware counts 16-bit milliseconds).
    """

    key_height_at_lower_stop_m: float = 0.35
    lift_stroke_m: float = 1.2
    button_of_servo: Sequence[int] = (1, 2)
    minimum_strength: float = 0.0
    maximum_strength: float = 1.0
    default_hold_s: float = 0.3
    maximum_hold_s: float = 10.0

    def __post_init__(self) -> None:
        check_range("key_height_at_lower_stop_m", self.key_height_at_lower_stop_m, 0.05, 1.5, "m")
        check_range("lift_stroke_m", self.lift_stroke_m, 0.05, 2.0, "m")
        check_range("maximum_strength", self.maximum_strength, 0.0, 1.0, "")
        check_range("minimum_strength", self.minimum_strength, 0.0, self.maximum_strength, "")
        check_range("maximum_hold_s", self.maximum_hold_s, 0.05, 60.0, "s")
        check_range("default_hold_s", self.default_hold_s, 0.05, self.maximum_hold_s, "s")
        check_range("length of button_of_servo", len(self.button_of_servo), 1, MAX_SERVOS, "")
        for button in self.button_of_servo:
            if not isinstance(button, int):
                raise ConfigurationError(f"Parameter button_of_servo holds {button!r}; allowed are whole numbers.")
            check_range("button_of_servo", button, 1, MAX_BUTTON, "")

    @property
    def highest_key_m(self) -> float:
        """Remote key above ground with the lift at its upper stop."""
        return self.key_height_at_lower_stop_m + self.lift_stroke_m

    def key_height_m(self, lift_height_m: float) -> float:
        """Height of the key above ground."""
        return self.key_height_at_lower_stop_m + lift_height_m

    def lift_height_m(self, key_height_m: float) -> float:
        """Height of the lift for a height of the key; NaN asks to hold still. Raises OrderRefused."""
        if math.isnan(key_height_m):
            return math.nan
        low, high = self.key_height_at_lower_stop_m, self.highest_key_m
        if not low - HEIGHT_ROUNDING_M <= key_height_m <= high + HEIGHT_ROUNDING_M:
            raise OrderRefused(f"Key height {key_height_m:g} m was refused; allowed is {low:g} to {high:g} m.")
        return min(max(key_height_m - low, 0.0), self.lift_stroke_m)

    def servos(self, buttons: Iterable[int]) -> int:
        """Bits of the servos that press the buttons. Raises OrderRefused."""
        bits = 0
        for button in buttons:
            if button not in self.button_of_servo:
                known = ", ".join(map(str, self.button_of_servo))
                raise OrderRefused(f"Button {button} was refused; this key's mount has servos for {known}.")
            bits |= 1 << list(self.button_of_servo).index(button)
        if not bits:
            raise OrderRefused("A press without a button was refused.")
        return bits

    def strength(self, strength: float) -> float:
        """The strength when it is allowed. Raises OrderRefused."""
        if not self.minimum_strength <= strength <= self.maximum_strength:
            raise OrderRefused(f"Strength {strength:g} was refused; allowed is {self.minimum_strength:g} "
                               f"to {self.maximum_strength:g}.")
        return strength

    def hold_ms(self, duration_s: float) -> int:
        """Time to hold in whole ms; 0 asks for the default. Raises OrderRefused."""
        if duration_s == 0.0:
            duration_s = self.default_hold_s
        if not 0.0 < duration_s <= self.maximum_hold_s:
            raise OrderRefused(f"Duration {duration_s:g} s was refused; "
                               f"allowed is above 0 to {self.maximum_hold_s:g} s.")
        return max(1, round(1000.0 * duration_s))
