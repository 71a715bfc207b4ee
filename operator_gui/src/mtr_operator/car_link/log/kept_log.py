"""Log of the bus during a test, and its position at the newest Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.ports import BusMark

from ..can_frame import CanFrame
from .bus_log import BusLog


class KeptLog:
    """Holder of the current log, if any. Called from the reader's thread and the test's, under the lock of the link to
    the Car.

    Attributes:
        mark: of the newest Status; None before the first one, and without a log.
    """

    def __init__(self) -> None:
        self._log: BusLog | None = None
        self.mark: BusMark | None = None
        self._restarts = 0

    def change(self, log: BusLog | None) -> BusLog | None:
        """Switch to another log, or to none; return the previous one, which must be closed without the lock."""
        former, self._log, self.mark, self._restarts = self._log, log, None, 0
        return former

    @property
    def frames(self) -> int:
        """Data frames in the log so far."""
        return 0 if self._log is None else self._log.frames

    @property
    def problem(self) -> str:
        """Reason why the log ends before the test; empty while it continues."""
        log = self._log
        return "" if log is None else log.problem

    def status(self, frames: int, arrival_s: float, told_s: float, stamps: str) -> None:
        """Record a Status, which arrived after this number of frames of the log; the other arguments as in BusMark."""
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
        """Restart after the adapter was reopened."""
        if self._log is not None:
            self._log.restart()
            self._restarts += 1
