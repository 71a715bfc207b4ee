"""Lift and button servos of the virtual robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.requests import Press
from mtr_operator.domain.robot_status import PressReport

MIN_KEY_M = 0.35
MAX_KEY_M = 1.55
LIFT_SPEED_MPS = 0.15
# Time a servo needs to reach the button.
SERVO_TRAVEL_S = 0.1
_KEPT_CONFIRMATIONS = 5
# Heights are sent as 32-bit floats: 0.35 arrives as 0.34999999.
_HEIGHT_ROUNDING_M = 1e-6


class VirtualKeyholder:
    """Lift and servos: moves the key to a height and presses its buttons, each press once by id."""

    def __init__(self) -> None:
        self.height_m = MIN_KEY_M
        self.confirmations: tuple[PressReport, ...] = ()
        self._wanted_m = MIN_KEY_M
        self._newest_press_id = 0
        self._press: Press | None = None
        self._start_s = 0.0

    def begin_session(self) -> None:
        """Discard the ids of the previous session."""
        self.confirmations = ()
        self._newest_press_id = 0

    def request(self, height_m: float | None, press: Press | None, time_s: float) -> None:
        """Accept the desired height and press; None changes nothing."""
        if height_m is not None and MIN_KEY_M - _HEIGHT_ROUNDING_M <= height_m <= MAX_KEY_M + _HEIGHT_ROUNDING_M:
            self._wanted_m = min(max(height_m, MIN_KEY_M), MAX_KEY_M)
        if press is not None and press.id > self._newest_press_id and self._press is None:
            self._newest_press_id = press.id
            self._press = press
            self._start_s = time_s + SERVO_TRAVEL_S

    def stop(self, press: Press | None, time_s: float) -> None:
        """Hold the key at its height; a press in progress ends by itself, a new one is rejected."""
        self._wanted_m = self.height_m
        if press is not None and press.id > self._newest_press_id and self._press is None:
            self._newest_press_id = press.id
            refused = PressReport(press.id, time_s, time_s, "The press was not begun: The robot is stopped.")
            self.confirmations = (*self.confirmations, refused)[-_KEPT_CONFIRMATIONS:]

    def step(self, time_s: float, dt_s: float) -> None:
        """Advance to time_s, which is dt_s later."""
        step_m = LIFT_SPEED_MPS * dt_s
        self.height_m += min(max(self._wanted_m - self.height_m, -step_m), step_m)
        press = self._press
        if press is not None and time_s >= self._start_s + press.duration_s:
            done = PressReport(press.id, self._start_s, self._start_s + press.duration_s)
            self.confirmations = (*self.confirmations, done)[-_KEPT_CONFIRMATIONS:]
            self._press = None

    def pressed_buttons(self, time_s: float) -> tuple[int, ...]:
        """Return the buttons that are held down at time_s."""
        return self._press.buttons if self._press is not None and time_s >= self._start_s else ()
