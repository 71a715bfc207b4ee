"""Parameters of the Relay resistance scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...parameter_lists import MAX_NUMBERS, parameter_list
from ...parameters import CENTIMETRES, KILOMETRES_PER_HOUR, parameter
from ...scenario import ScenarioParameters
from ...verdict.requirement import SIDES
from ..handle.hand import BUTTON, ITSELF

# The driver's door of most cars; a file without a side means it.
_DRIVERS_SIDE, ALL_SIDES = "left", "all"
_SIDES = (_DRIVERS_SIDE, *(side for side in SIDES if side != _DRIVERS_SIDE), ALL_SIDES)
# So far beyond the border a key is surely outside, with all that the robot's place leaves open.
BEYOND_M = 0.2
# Rounding of a sum must not refuse what is allowed up to exactly there.
_ROUNDING_M = 1e-9


@dataclass(frozen=True)
class RelayResistanceParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    side: str = choice(
        _SIDES, _DRIVERS_SIDE, "Side or corner of the Car at which the extender is tried: that of the handle that is "
        "taken.")
    minimum_distance_m: float = parameter(
        0.6, 0.0, 20.0, "m", "Where the key has to unlock the Car, well inside the zone: a key that is not heard there "
        "says nothing by its silence farther away.")
    border_distance_m: float = parameter(
        1.5, 0.0, 49.0, "m", "Nominal border of the zone; an unlock beyond it is one too many.")
    maximum_distance_m: float = parameter(
        3.0, 0.1, 50.0, "m", "Farthest place at which the key is carried, and starting distance of each axis.")
    places_m: tuple[float, ...] | None = parameter_list(
        0.1, 50.0, "m", f"Places beyond the border at which the handle is taken, up to {MAX_NUMBERS}. Without it half "
        "way from the border to the farthest place, and there.")
    requests_per_place: int = parameter(
        5, 1, 200, "", "Requests at each place with the extender off, and again with it on.")
    measurements_distance_m: float = parameter(1.0, 0.05, 10.0, "m", "Distance between neighbouring axes of a side.")
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.", shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    settle_time_s: float = parameter(0.3, 0.0, 60.0, "s", "Standstill before each request.")
    response_timeout_s: float = parameter(
        1.5, 0.1, 60.0, "s", "How long after the handle was taken the Car may take to unlock; outside otherwise.")
    handle_timeout_s: float = parameter(
        120.0, 1.0, 3600.0, "s", "How long the Operator may take to come to the handle before the test is interrupted.")
    switch_timeout_s: float = parameter(
        300.0, 1.0, 3600.0, "s", "How long the Operator may take to switch the extender before the test is "
        "interrupted.")
    relock: str = choice(
        (BUTTON, ITSELF), BUTTON, "How the Car is locked again after each unlock. button: the robot presses the "
        "key's lock button. itself: the robot drives away and waits, for a key whose button it cannot press.")
    press_strength: float = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
    press_duration_s: float = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
    lock_timeout_s: float = parameter(
        60.0, 1.0, 3600.0, "s", "How long the Car may take to lock by itself, as the key goes away or by its timer.")
    key_rest_limit_s: float = parameter(
        45.0, 5.0, 55.0, "s", "Standstill after which the Remote key is moved before the handle is taken, so that it "
        "does not sleep.")
    wake_move_m: float = parameter(
        0.2, 0.06, 2.0, "m", "How far the key is moved and brought back before each trial, so that it is awake.",
        shown=CENTIMETRES)
    clearance_m: float = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")

    def check(self) -> None:
        """Constraints between parameters."""
        if self.minimum_distance_m < self.clearance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {self.minimum_distance_m:g} m; allowed is "
                                   f"clearance_m, {self.clearance_m:g} m, and more.")
        if self.minimum_distance_m > self.border_distance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {self.minimum_distance_m:g} m; it has to be at "
                                   f"most border_distance_m, {self.border_distance_m:g} m.")
        for place_m in self.tried_places_m:
            if not self.border_distance_m + BEYOND_M - _ROUNDING_M <= place_m <= self.maximum_distance_m + _ROUNDING_M:
                raise InvalidParameter(
                    f"Parameter places_m has {place_m:g} m; allowed is {self.border_distance_m + BEYOND_M:g} m, which "
                    f"is {BEYOND_M:g} m beyond border_distance_m, to {self.maximum_distance_m:g} m, "
                    "maximum_distance_m.")

    @property
    def tried_places_m(self) -> tuple[float, ...]:
        """Places beyond the border, from near to far."""
        far_m = self.maximum_distance_m
        return tuple(sorted(set(self.places_m or ((self.border_distance_m + far_m) / 2.0, far_m))))
