"""Parameters of the Relay resistance scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...parameter_lists import MAX_NUMBERS, parameter_list
from ...parameters import parameter
from ...scenario import ScenarioParameters
from ..handle.fields import ALL_SIDES, DRIVERS_SIDE, ROUNDING_M, SIDES_FROM_DRIVERS, HandleFields, check_clearance

# So far beyond the border a key is surely outside, with all that the robot's place leaves open.
BEYOND_M = 0.2

_HANDLE = HandleFields()


@dataclass(frozen=True)
class RelayResistanceParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    side: str = choice(
        (*SIDES_FROM_DRIVERS, ALL_SIDES), DRIVERS_SIDE,
        "Side or corner of the Car at which the extender is tried: that of the handle that is taken.")
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
    key_height_m: float = _HANDLE.key_height_m
    maximum_speed_mps: float = _HANDLE.maximum_speed_mps
    settle_time_s: float = _HANDLE.settle_time_s
    response_timeout_s: float = _HANDLE.response_timeout_s
    handle_timeout_s: float = _HANDLE.handle_timeout_s
    switch_timeout_s: float = parameter(
        300.0, 1.0, 3600.0, "s", "How long the Operator may take to switch the extender before the test is "
        "interrupted.")
    relock: str = _HANDLE.relock
    press_strength: float = _HANDLE.press_strength
    press_duration_s: float = _HANDLE.press_duration_s
    lock_timeout_s: float = _HANDLE.lock_timeout_s
    key_rest_limit_s: float = _HANDLE.key_rest_limit_s
    wake_move_m: float = _HANDLE.wake_move_m
    clearance_m: float = _HANDLE.clearance_m

    def check(self) -> None:
        """Constraints between parameters."""
        check_clearance(self.minimum_distance_m, self.clearance_m)
        if self.minimum_distance_m > self.border_distance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {self.minimum_distance_m:g} m; it has to be at "
                                   f"most border_distance_m, {self.border_distance_m:g} m.")
        for place_m in self.tried_places_m:
            if not self.border_distance_m + BEYOND_M - ROUNDING_M <= place_m <= self.maximum_distance_m + ROUNDING_M:
                raise InvalidParameter(
                    f"Parameter places_m has {place_m:g} m; allowed is {self.border_distance_m + BEYOND_M:g} m, which "
                    f"is {BEYOND_M:g} m beyond border_distance_m, to {self.maximum_distance_m:g} m, "
                    "maximum_distance_m.")

    @property
    def tried_places_m(self) -> tuple[float, ...]:
        """Places beyond the border, from near to far."""
        far_m = self.maximum_distance_m
        return tuple(sorted(set(self.places_m or ((self.border_distance_m + far_m) / 2.0, far_m))))
