"""The log that a test keeps of the bus, and how far it had come with the newest Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.ports import BusMark

from ..can_frame import CanFrame
from .bus_log import BusLog


class KeptLog:
    """No log until one is given. Called from the reader's thread and the test's, under the lock of the link to the Car.

    Attributes:
        mark: of the newest Status; None before the first one, and without a log.
    """

    def __init__(self) -> None:
        self._log: BusLog | None = None
        self.mark: BusMark | None = None
        self._restarts = 0

    def change(self, log: BusLog | None) -> BusLog | None:
        """Go on in another log, or in none; the one of before, which is to be closed without the lock."""
        former, self._log, self.mark, self._restarts = self._log, log, None, 0
        return former

    @property
    def frames(self) -> int:
        """Data frames in the log so far."""
        return 0 if self._log is None else self._log.frames

    @property
    def problem(self) -> str:
        """Why the log ends before the test does; empty while it goes on."""
        log = self._log
        return "" if log is None else log.problem

    def status(self, frames: int, arrival_s: float, told_s: float, stamps: str) -> None:
        """A Status was observed: it came when the log had so many frames; the rest as BusMark has it."""
        if self._log is not None:
            self.mark = BusMark(frames, self._log.frames, arrival_s, told_s, self._log.origin_s, stamps,
                                self._restarts)

    def frame(self, frame: CanFrame, local_s: float, channel: int = 0) -> None:
        """See BusLog."""
        if self._log is not None:
            self._log.frame(frame, local_s, channel)

    def error_frame(self) -> None:
        """See BusLog."""
        if self._log is not None:
            self._log.error_frame()

    def restart(self) -> None:
        """The adapter was opened anew."""
        if self._log is not None:
            self._log.restart()
            self._restarts += 1
