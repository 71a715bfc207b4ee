"""Calibration of the servos: the only place that assigns servos to buttons."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Iterable, Tuple

from mtr_core.errors import check_range
from mtr_core.parameters import ParameterSet, number
from mtr_core.problems import ProblemError

from . import problems

MAX_SERVOS = 2
MAX_BUTTON = 255


class RequestRefused(ProblemError):
    """The lift or a servo cannot execute the request."""


@dataclass(frozen=True)
class Calibration(ParameterSet):
    """Values of config/calibration.yaml.

    Attributes:
        button_of_servo: number of the button that each servo presses, in the firmware's order; 1 or 2 servos.
        minimum_strength, maximum_strength: allowed travel of a press as a share of the servo's travel.
        default_hold_s: hold time of a button if the order specifies none.
        maximum_hold_s: longest hold time of a button; the firmware counts 16-bit milliseconds.
    """

    button_of_servo: Tuple[int, ...] = (1, 2)
    minimum_strength: float = number(0.0, 0.0, 1.0)
    maximum_strength: float = number(1.0, 0.0, 1.0)
    default_hold_s: float = number(0.3, 0.05, 60.0, "s")
    maximum_hold_s: float = number(10.0, 0.05, 60.0, "s")

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("minimum_strength", self.minimum_strength, 0.0, self.maximum_strength)
        check_range("default_hold_s", self.default_hold_s, 0.05, self.maximum_hold_s, "s")
        check_range("length of button_of_servo", len(self.button_of_servo), 1, MAX_SERVOS)
        for button in self.button_of_servo:
            check_range("button_of_servo", button, 1, MAX_BUTTON)

    def servos(self, buttons: Iterable[int]) -> int:
        """Return the bits of the servos that press the buttons. Raises RequestRefused."""
        bits = 0
        for button in buttons:
            if button not in self.button_of_servo:
                known = ", ".join(map(str, self.button_of_servo))
                raise RequestRefused(problems.UNKNOWN_BUTTON(button=button, known=known))
            bits |= 1 << self.button_of_servo.index(button)
        if not bits:
            raise RequestRefused(problems.NO_BUTTON())
        return bits

    def strength(self, strength: float) -> float:
        """Return the strength if it is allowed. Raises RequestRefused."""
        if not self.minimum_strength <= strength <= self.maximum_strength:
            raise RequestRefused(problems.STRENGTH(value=strength, low=self.minimum_strength,
                                                   high=self.maximum_strength))
        return strength

    def hold_ms(self, duration_s: float) -> int:
        """Return the hold time in whole ms; a duration of 0 selects the default. Raises RequestRefused."""
        if duration_s == 0.0:
            duration_s = self.default_hold_s
        if not 0.0 < duration_s <= self.maximum_hold_s:
            raise RequestRefused(problems.DURATION(value=duration_s, high=self.maximum_hold_s))
        return max(1, round(1000.0 * duration_s))
