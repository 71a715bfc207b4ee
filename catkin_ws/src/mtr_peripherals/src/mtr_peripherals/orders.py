"""Sends the core's decisions as orders that are valid until a time of the firmware's clock."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable

from .conversions import FirmwareTimes, command_message, press_message, signals_message
from .core import STOPPED, Outcome

# Lifetime of a command: longer than its period, shorter than the silence that stops the firmware.
COMMAND_LIFETIME_NS = 500_000_000


class FirmwareOrders:
    """Sends nothing before the firmware's clock is known, and nothing after the end."""

    def __init__(self, times: FirmwareTimes, send_command: Callable[[Any], None], send_press: Callable[[Any], None],
                 send_signals: Callable[[Any], None]):
        self._times, self._send_signals = times, send_signals
        self._send_command, self._send_press = send_command, send_press
        self._seq = 0
        self._has_ended = False

    def send(self, outcome: Outcome, now_ns: int) -> None:
        """Send the orders that were decided at now_ns of the steady clock."""
        latest_us = self._times.firmware_us(now_ns + COMMAND_LIFETIME_NS)
        if latest_us is None or self._has_ended:
            return
        # Signals come first, so that the board knows of its stop input before it moves anything.
        if outcome.signals:
            self._send_signals(signals_message(outcome.signals, latest_us))
        self._seq += 1
        self._send_command(command_message(outcome, self._seq, latest_us))
        press_latest_us = self._times.firmware_us(outcome.press.latest_ns) if outcome.press else None
        if outcome.press and press_latest_us is not None:
            self._send_press(press_message(outcome.press, press_latest_us))

    def end(self, now_ns: int) -> None:
        """Stop lift and servos at once instead of by the firmware's time-out."""
        self.send(STOPPED, now_ns)
        self._has_ended = True
