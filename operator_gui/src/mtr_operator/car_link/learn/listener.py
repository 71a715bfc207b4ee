"""Receives the frames of the Car's bus without a profile; it never sends."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time
from typing import Callable

from ..adapter import AdapterSettings, open_adapter
from ..bus_trouble import BusTrouble
from ..can_frame import CanFrame
from ..reader import CanReader, FrameSink


class Listener(FrameSink):
    """Owner of the adapter between start() and stop(). heard: called in its thread with each data frame. clock: the
    laptop's, monotonic, in s."""

    def __init__(self, settings: AdapterSettings, heard: Callable[[CanFrame], None],
                 clock: Callable[[], float] = time.monotonic):
        self._heard = heard
        self._fault = ""
        self._trouble = BusTrouble(settings)
        self._reader = CanReader(lambda: open_adapter(settings), self, settings.interface, clock)

    def start(self) -> None:
        """Open the adapter and start to receive; ConnectionFailed if that is not possible."""
        self._reader.start()

    def stop(self) -> None:
        """Close the adapter."""
        self._reader.stop()

    @property
    def problem(self) -> str:
        """Current fault of the adapter as one sentence; empty without one."""
        return self._fault or self._trouble.no_frame

    def frame(self, frame: CanFrame) -> None:
        self._trouble.frame(frame)
        self._heard(frame)

    def error_frame(self) -> None:
        """See FrameSink: a few error frames are ignored; many without a data frame indicate a wrong bit rate."""
        self._trouble.error_frame()

    def frames_lost(self) -> None:
        """See FrameSink: the received frames suffice to find what follows the locks."""

    def fault(self, text: str) -> None:
        self._fault = text

    def reopened(self) -> None:
        pass
