"""Parameters of the Sleep time scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...parameters import CENTIMETRES, KILOMETRES_PER_HOUR, parameter
from ...scenario import ScenarioParameters
from ...verdict.requirement import SIDES
from ..handle.hand import BUTTON, ITSELF
from .waits import WaitPlan

# The driver's door of most cars; a file without a side means it.
_DRIVERS_SIDE = "left"
_SIDES = (_DRIVERS_SIDE, *(side for side in SIDES if side != _DRIVERS_SIDE))
# Rounding of a sum must not refuse what is allowed up to exactly there.
_ROUNDING_M = 1e-9


@dataclass(frozen=True)
class SleepTimeParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis of its middle."""

    side: str = choice(
        _SIDES, _DRIVERS_SIDE, "Side or corner of the Car at which the key is held: that of the handle that is taken.")
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
    wake_move_m: float = parameter(
        0.2, 0.06, 2.0, "m", "How far the key is moved and brought back before each trial, so that it is awake.",
        shown=CENTIMETRES)
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.", shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    settle_time_s: float = parameter(0.3, 0.0, 60.0, "s", "Standstill before each request.")
    response_timeout_s: float = parameter(
        1.5, 0.1, 60.0, "s", "How long after the handle was taken the Car may take to unlock; outside otherwise.")
    handle_timeout_s: float = parameter(
        120.0, 1.0, 3600.0, "s", "How long the Operator may take to come to the handle before the test is interrupted.")
    relock: str = choice(
        (BUTTON, ITSELF), BUTTON, "How the Car is locked again after each unlock. button: the robot presses the "
        "key's lock button. itself: the robot drives away and waits, for a key whose button it cannot press.")
    press_strength: float = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
    press_duration_s: float = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
    lock_timeout_s: float = parameter(
        60.0, 1.0, 3600.0, "s", "How long the Car may take to lock by itself, as the key goes away or by its timer.")
    clearance_m: float = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")

    def check(self) -> None:
        """Constraints between parameters."""
        if self.minimum_distance_m < self.clearance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {self.minimum_distance_m:g} m; allowed is "
                                   f"clearance_m, {self.clearance_m:g} m, and more.")
        if self.minimum_distance_m + self.wake_move_m > self.maximum_distance_m + _ROUNDING_M:
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
