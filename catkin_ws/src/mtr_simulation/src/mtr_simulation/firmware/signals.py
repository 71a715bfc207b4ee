"""Stop input, buzzer and beacon of the simulated firmware."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import NamedTuple

CLOSE_NS = 100_000_000
SILENCE_NS = 1_000_000_000
LAST_SIGNAL = 2


class StopState(enum.IntEnum):
    """Values of FirmwareInputs.stop."""

    UNUSED = 0
    CLOSED = 1
    OPEN = 2


class InputState(NamedTuple):
    """Fields of mtr_msgs/FirmwareInputs except the checksum."""

    time_us: int
    stop: int
    stops: int
    signal: int
    beacon: int


class Signals:
    """Contact that opens at once and closes slowly, and signals that end with their orders.

    Attributes:
        contact_is_open: contact of the stop chain; initially closed, as in a fitted and released chain.
    """

    def __init__(self) -> None:
        self.contact_is_open = False
        self.signal, self.has_beacon = 0, False
        self._is_used, self._is_open, self._stops = False, True, 0
        self._opened_ns, self._ordered_ns = 0, 0

    @property
    def is_stopped(self) -> bool:
        """True while an input in use is open."""
        return self._is_used and self._is_open

    def order(self, signal: int, has_beacon: bool, uses_stop_input: bool, now_ns: int) -> bool:
        """Execute an order; return False if the signal does not exist."""
        self._is_used = self._is_used or uses_stop_input
        if not 0 <= signal <= LAST_SIGNAL:
            return False
        self.signal, self.has_beacon, self._ordered_ns = signal, has_beacon, now_ns
        return True

    def step(self, now_ns: int) -> bool:
        """Advance to now_ns; return True if an input in use has just opened."""
        if now_ns - self._ordered_ns > SILENCE_NS:
            self.signal = 0
        if not self.contact_is_open:
            self._is_open = self._is_open and now_ns - self._opened_ns < CLOSE_NS
            return False
        self._opened_ns = now_ns
        has_opened = self._is_used and not self._is_open
        self._is_open = True
        self._stops += has_opened
        return has_opened

    def state(self, time_us: int) -> InputState:
        """Return the board's report."""
        stop = StopState.UNUSED if not self._is_used else StopState.OPEN if self._is_open else StopState.CLOSED
        return InputState(time_us, int(stop), self._stops % (1 << 16), self.signal, int(self.has_beacon))
