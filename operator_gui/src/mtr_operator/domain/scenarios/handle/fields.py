"""Parameters that all scenarios with a hand at the handle have."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ...choice import choice
from ...errors import InvalidParameter
from ...parameters import CENTIMETRES, KILOMETRES_PER_HOUR, parameter
from ...verdict.requirement import SIDES
from .hand import BUTTON, ITSELF

# The driver's door of most cars; a file without a side means it.
DRIVERS_SIDE, ALL_SIDES = "left", "all"
SIDES_FROM_DRIVERS = (DRIVERS_SIDE, *(side for side in SIDES if side != DRIVERS_SIDE))
# Rounding of a sum must not refuse what is allowed up to exactly there.
ROUNDING_M = 1e-9


class HandleFields:
    """Fields of what they have in common; one of these for each dataclass. Where in the file they stand is the
    dataclass' own order, so that it names them."""

    def __init__(self) -> None:
        self.key_height_m = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.",
                                      shown=CENTIMETRES)
        self.maximum_speed_mps = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                           shown=KILOMETRES_PER_HOUR)
        self.settle_time_s = parameter(0.3, 0.0, 60.0, "s", "Standstill before each request.")
        self.response_timeout_s = parameter(
            1.5, 0.1, 60.0, "s", "How long after the handle was taken the Car may take to unlock; outside otherwise.")
        self.handle_timeout_s = parameter(
            120.0, 1.0, 3600.0, "s", "How long the Operator may take to come to the handle before the test is "
            "interrupted.")
        self.relock = choice(
            (BUTTON, ITSELF), BUTTON, "How the Car is locked again after each unlock. button: the robot presses the "
            "key's lock button. itself: the robot drives away and waits, for a key whose button it cannot press.")
        self.press_strength = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
        self.press_duration_s = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
        self.lock_timeout_s = parameter(
            60.0, 1.0, 3600.0, "s", "How long the Car may take to lock by itself, as the key goes away or by its "
            "timer.")
        self.key_rest_limit_s = parameter(
            45.0, 5.0, 55.0, "s", "Standstill after which the Remote key is moved before the handle is taken, so that "
            "it does not sleep.")
        self.wake_move_m = parameter(
            0.2, 0.06, 2.0, "m", "How far the key is moved and brought back before each trial, so that it is awake.",
            shown=CENTIMETRES)
        self.clearance_m = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")


def check_clearance(minimum_distance_m: float, clearance_m: float) -> None:
    """Raise InvalidParameter when the nearest place lies within the gap that has to remain."""
    if minimum_distance_m < clearance_m:
        raise InvalidParameter(f"Parameter minimum_distance_m is {minimum_distance_m:g} m; allowed is clearance_m, "
                               f"{clearance_m:g} m, and more.")
