"""Stops a test on the Car's signals: ignition on, a gear other than P, a moving Car, an opened door or lid."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import math
from typing import Iterator

from .car_signals import DOOR, CarSignal, CarSignals, SignalState, first_active

# Robot time in which a person closes a door that was opened with the handle.
DOOR_CLOSING_S = 5.0


class CarGuard:
    """Watch of the signals from begin() on; inactive before it.

    Attributes:
        reason: sentence of the signal that stopped the test, empty without one; it remains until the test ends.
    """

    def __init__(self) -> None:
        self.reason = ""
        self._is_active = False
        self._ignored: set[str] = set()
        self._is_handle_pulled = False
        self._closed_by_s = -math.inf

    def begin(self, signals: CarSignals) -> str:
        """Start to watch; return a sentence if a signal already forbids motion. Doors that are open now are ignored
        until they are closed, because the checklist shows them."""
        self._is_active = True
        self._ignored = {each.name for each in _open_doors(signals)}
        active = first_active(signals)
        return "" if active is None else active.sentence

    @contextlib.contextmanager
    def handle_pulled(self) -> Iterator[None]:
        """Context in which a person pulls a handle, and a door may open with it."""
        self._is_handle_pulled = True
        try:
            yield
        finally:
            self._is_handle_pulled = False
            self._closed_by_s = math.nan

    def learn(self, signals: CarSignals, now_s: float) -> bool:
        """Return True when one of the signals at this robot time stops the test for the first time."""
        if not self._is_active or self.reason:
            return False
        active = first_active(signals) or self._opened(signals, now_s)
        self.reason = "" if active is None else active.sentence
        return active is not None

    def _opened(self, signals: CarSignals, now_s: float) -> CarSignal | None:
        """Return the first door that counts as opened."""
        if math.isnan(self._closed_by_s):
            self._closed_by_s = now_s + DOOR_CLOSING_S
        # Robot time may be set back.
        self._closed_by_s = min(self._closed_by_s, now_s + DOOR_CLOSING_S)
        opened = _open_doors(signals)
        closed = {each.name for each in signals if each.kind == DOOR and each.state is SignalState.CLEAR}
        self._ignored -= closed
        if self._is_handle_pulled or now_s < self._closed_by_s:
            return None
        return next((each for each in opened if each.name not in self._ignored), None)


def _open_doors(signals: CarSignals) -> list[CarSignal]:
    return [each for each in signals if each.kind == DOOR and each.state is SignalState.ACTIVE]
