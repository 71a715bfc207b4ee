"""Parameters of the Sleep time scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...parameters import parameter
from ...scenario import ScenarioParameters
from ..handle.fields import DRIVERS_SIDE, ROUNDING_M, SIDES_FROM_DRIVERS, HandleFields, check_clearance
from .waits import WaitPlan

_HANDLE = HandleFields()


@dataclass(frozen=True)
class SleepTimeParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis of its middle."""

    side: str = choice(
        SIDES_FROM_DRIVERS, DRIVERS_SIDE,
        "Side or corner of the Car at which the key is held: that of the handle that is taken.")
    minimum_distance_m: float = parameter(
        0.6, 0.0, 20.0, "m", "Where the Remote key is held still, well inside the zone.")
    maximum_distance_m: float = parameter(2.0, 0.1, 50.0, "m", "Starting distance of each axis.")
    shortest_wait_s: float = parameter(30.0, 1.0, 3600.0, "s", "Rest after which the key is asked first.")
    longest_wait_s: float = parameter(
        1800.0, 2.0, 14400.0, "s", "Longest rest; a key that still answers after it is recorded as awake for at least "
        "so long.")
    interval_s: float = parameter(
        10.0, 0.5, 600.0, "s", "Time between the last answer and the first silence at which the search ends.")
    confirmations: int = parameter(
        2, 1, 10, "", "Trials at each end of that time that have to agree.")
    requests: int = parameter(
        3, 1, 10, "", "Requests without an answer, one right after the other, before the key counts as asleep.")
    trials_limit: int = parameter(24, 4, 200, "", "Trials after which the search ends although its interval is wider.")
    wake_move_m: float = _HANDLE.wake_move_m
    key_height_m: float = _HANDLE.key_height_m
    maximum_speed_mps: float = _HANDLE.maximum_speed_mps
    settle_time_s: float = _HANDLE.settle_time_s
    response_timeout_s: float = _HANDLE.response_timeout_s
    handle_timeout_s: float = _HANDLE.handle_timeout_s
    relock: str = _HANDLE.relock
    press_strength: float = _HANDLE.press_strength
    press_duration_s: float = _HANDLE.press_duration_s
    lock_timeout_s: float = _HANDLE.lock_timeout_s
    clearance_m: float = _HANDLE.clearance_m

    def check(self) -> None:
        """Constraints between parameters."""
        check_clearance(self.minimum_distance_m, self.clearance_m)
        if self.minimum_distance_m + self.wake_move_m > self.maximum_distance_m + ROUNDING_M:
            raise InvalidParameter(
                f"Parameter wake_move_m is {self.wake_move_m:g} m; allowed is at most "
                f"{max(self.maximum_distance_m - self.minimum_distance_m, 0.0):g} m, up to maximum_distance_m.")
        if self.longest_wait_s <= self.shortest_wait_s:
            raise InvalidParameter(f"Parameter longest_wait_s is {self.longest_wait_s:g} s; it has to be longer than "
                                   f"shortest_wait_s, {self.shortest_wait_s:g} s.")
        if self.interval_s <= 2.0 * self._span_s:
            raise InvalidParameter(
                f"Parameter interval_s is {self.interval_s:g} s; allowed is more than {2.0 * self._span_s:g} s, for "
                "the requests to a silent key take half of that; decrease requests or response_timeout_s.")

    @property
    def _span_s(self) -> float:
        """From the first to the last request of a trial without an answer."""
        return (self.requests - 1) * self.response_timeout_s

    @property
    def wait_plan(self) -> WaitPlan:
        """What is wanted of the waits."""
        return WaitPlan(self.shortest_wait_s, self.longest_wait_s, self.interval_s, self.confirmations,
                        self.trials_limit, self._span_s)
