"""Press of the key's buttons by two servos: travel, hold, and a release that does not depend on the host."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import NamedTuple, Optional, Tuple

RELEASED_US = 1000
TRAVEL_US = 1000  # added at full travel
TRAVEL_NS = 100_000_000  # travel time of a servo between two pulse widths

MIN_HOLD_MS = 20
MAX_HOLD_MS = 10_000


class PressState(enum.IntEnum):
    """Values of FirmwareState.press_state."""

    NONE = 0
    PRESSING = 1
    DONE = 2
    REFUSED = 3


class PressRequest(NamedTuple):
    """One requested press; servos: bit 0 lock, bit 1 unlock."""

    id: int
    servos: int
    strength: float
    hold_ms: int

    def is_valid(self) -> bool:
        """Return True if the servos can execute it; NaN is invalid."""
        hold_fits = MIN_HOLD_MS <= self.hold_ms <= MAX_HOLD_MS
        return self.servos in (1, 2, 3) and 0.0 <= self.strength <= 1.0 and hold_fits


class Presser:
    """The two servos and the current press.

    Attributes:
        servo_us: pulse widths of lock and unlock servo.
    """

    def __init__(self) -> None:
        self.servo_us: Tuple[float, float] = (RELEASED_US, RELEASED_US)
        self._request: Optional[PressRequest] = None
        self._start_ns = 0
        self._release_ns: Optional[int] = None
        self._from_us: Tuple[float, float] = self.servo_us

    @property
    def is_busy(self) -> bool:
        """True from the request to the release."""
        return self._request is not None

    @property
    def reached_ns(self) -> int:
        """End of the travel of the last request."""
        return self._start_ns + TRAVEL_NS

    def start(self, request: PressRequest, time_ns: int) -> None:
        """Start a valid request; must not be busy."""
        self._request = request
        self._start_ns = time_ns
        self._from_us = self.servo_us
        self._release_ns = None

    def step(self, time_ns: int) -> Optional[int]:
        """Move the servos; return the time of the release if it happened in this step."""
        released_ns = None
        if self._request and time_ns >= self.reached_ns + self._request.hold_ms * 1_000_000:
            released_ns = self.reached_ns + self._request.hold_ms * 1_000_000
            self._release(released_ns)
        self._move(time_ns)
        return released_ns

    def abort(self, time_ns: int) -> None:
        """Release immediately."""
        if self._request:
            self._release(time_ns)

    def _release(self, time_ns: int) -> None:
        self._move(time_ns)
        self._request = None
        self._from_us = self.servo_us
        self._release_ns = time_ns

    def _move(self, time_ns: int) -> None:
        began_ns = self._start_ns if self._release_ns is None else self._release_ns
        way = max(0.0, min(1.0, (time_ns - began_ns) / TRAVEL_NS))
        lock_us, unlock_us = self._from_us
        lock_goal_us, unlock_goal_us = self._goal()
        self.servo_us = (lock_us + way * (lock_goal_us - lock_us), unlock_us + way * (unlock_goal_us - unlock_us))

    def _goal(self) -> Tuple[float, float]:
        if self._request is None:
            return RELEASED_US, RELEASED_US
        pressed_us = RELEASED_US + self._request.strength * TRAVEL_US
        lock, unlock = self._request.servos & 1, self._request.servos & 2
        return (pressed_us if lock else RELEASED_US), (pressed_us if unlock else RELEASED_US)
