"""Ctrl-C as a request that the runner checks between two Status messages, so that the robot is stopped properly."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import signal
from types import FrameType
from typing import Any


class Interrupt:
    """Context in which the first Ctrl-C, or a request to terminate, sets `requested`; the second Ctrl-C aborts."""

    _SIGNALS = (signal.SIGINT, signal.SIGTERM)

    def __init__(self) -> None:
        self.requested = False
        self._former: Any = {}

    def __enter__(self) -> Interrupt:
        for number in self._SIGNALS:
            self._former[number] = signal.signal(number, self._take)
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._former.items():
            signal.signal(number, handler)

    def is_requested(self) -> bool:
        """Return True after the Operator requested the end."""
        return self.requested

    def _take(self, _number: int, _frame: FrameType | None) -> None:
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True
