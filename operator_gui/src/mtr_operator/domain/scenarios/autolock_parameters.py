"""Parameters of the Autolock scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..errors import InvalidParameter
from ..parameter_lists import MAX_NUMBERS, parameter_list
from ..parameters import CENTIMETRES, KILOMETRES_PER_HOUR, parameter
from ..scenario import ScenarioParameters

MIN_SPEED_MPS = 0.05


@dataclass(frozen=True)
class AutolockParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    minimum_distance_m: float = parameter(0.5, 0.0, 20.0, "m", "Where the approach ends if the Car stays locked.")
    maximum_distance_m: float = parameter(4.0, 0.1, 50.0, "m", "Starting distance of each axis.")
    straightening_distance_m: float = parameter(
        0.5, 0.0, 20.0, "m", "First piece of the approach, to correct the heading; the retreat ends where it ended.")
    measurements_distance_m: float = parameter(0.5, 0.05, 10.0, "m", "Distance between neighbouring axes of a side.")
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.",
                                    shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    measuring_speed_mps: float | None = parameter(
        None, MIN_SPEED_MPS, 2.0, "m/s", "Speed limit while approaching and retreating; default: the maximum speed.",
        shown=KILOMETRES_PER_HOUR)
    passes: int = parameter(
        1, 1, MAX_NUMBERS, "", "Approaches and retreats on each axis; those at two speeds tell the Car's reaction time "
                               "from the static boundary.")
    measuring_speeds_mps: tuple[float, ...] | None = parameter_list(
        MIN_SPEED_MPS, 2.0, "m/s", "Speed limits of the passes, in turn; default: proposed from the cycle of the Car's "
                                   "message.", shown=KILOMETRES_PER_HOUR)
    boundary_sigma_m: float = parameter(
        0.03, 0.005, 1.0, "m", "Sigma of the static boundary for which the speeds are proposed.", shown=CENTIMETRES)
    last_step_m: float | None = parameter(
        None, 0.01, 0.5, "m", "Step of one more approach, with a stop for the response time after each, for Cars that "
                              "poll slowly; default: none.", shown=CENTIMETRES)
    clearance_m: float = parameter(
        0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")
    response_timeout_s: float = parameter(
        1.0, 0.0, 60.0, "s", "How long the Car may take to react at the end of the approach and of the retreat.")
    lock_timeout_s: float = parameter(
        10.0, 0.5, 300.0, "s", "How long to wait at the starting distance for the Car to be locked.")

    def check(self) -> None:
        """Constraints between parameters."""
        low, high = self.minimum_distance_m, self.maximum_distance_m
        if low >= high:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; it has to be below "
                                   f"maximum_distance_m, {high:g} m.")
        if self.straightening_distance_m >= high - low:
            raise InvalidParameter(
                f"Parameter straightening_distance_m is {self.straightening_distance_m:g} m; it has to be below "
                f"maximum_distance_m - minimum_distance_m, {high - low:g} m.")
        if low < self.clearance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; allowed is clearance_m, "
                                   f"{self.clearance_m:g} m, and more.")
        if self.speed_on_axis_mps > self.maximum_speed_mps:
            raise InvalidParameter(f"Parameter measuring_speed_mps is {self.speed_on_axis_mps:g} m/s; allowed is at "
                                   f"most maximum_speed_mps, {self.maximum_speed_mps:g} m/s.")
        self._check_speeds(self.measuring_speeds_mps or ())

    def _check_speeds(self, speeds_mps: tuple[float, ...]) -> None:
        if speeds_mps and max(speeds_mps) > self.maximum_speed_mps:
            raise InvalidParameter(f"Parameter measuring_speeds_mps is {max(speeds_mps):g} m/s; allowed is at most "
                                   f"maximum_speed_mps, {self.maximum_speed_mps:g} m/s.")
        if speeds_mps and self.measuring_speed_mps is not None:
            raise InvalidParameter("Parameters measuring_speed_mps and measuring_speeds_mps are both given; give one.")
        if len(speeds_mps) > self.passes:
            raise InvalidParameter(f"Parameter passes is {self.passes}; allowed is at least one for each of the "
                                   f"{len(speeds_mps)} speeds of measuring_speeds_mps.")

    @property
    def speed_on_axis_mps(self) -> float:
        """Speed limit while approaching and retreating."""
        return self.maximum_speed_mps if self.measuring_speed_mps is None else self.measuring_speed_mps

    @property
    def straightened_distance_m(self) -> float:
        """Where the straightening ends and the retreat too."""
        return self.maximum_distance_m - self.straightening_distance_m
