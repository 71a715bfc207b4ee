"""Writes the whole bus to a log with python-can's own writers, in a separate thread: frames do not wait for the disk.

Times in the log are of the clock that times the frames, shifted so that the first one has the time of day. After the
adapter was reopened, they continue with the time of day again.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import math
import pathlib
import queue
import threading
import time
from typing import Any

import can

from mtr_operator.domain.errors import OutputError

from ..can_frame import CanFrame

FORMATS = ("blf", "asc", "trc", "mf4")
# The library cannot write CAN FD frames to these formats.
_CLASSIC_ONLY = (".trc",)
_NO_FD = "A CAN log of the format {} holds no CAN FD frame; choose blf or asc (--can-log-format)."
# One hour at 500 kbit/s and full load gives about 300 MB of BLF.
DEFAULT_LIMIT_BYTES = 2 * 1024 ** 3
# A killed application loses at most this much of a BLF, some hundred frames.
_BLF_CONTAINER_BYTES = 16 * 1024
# Frames between two checks of the file size.
_SIZE_LOOK = 1000


class BusLog:
    """Log that is open from its constructor on; OutputError states why it cannot be opened.

    Attributes:
        frames: data frames so far. origin_s: time of the first one by its own clock, NaN before it.
        problem: reason why the log ends before the test; empty while it continues.
    """

    def __init__(self, path: pathlib.Path, limit_bytes: int = DEFAULT_LIMIT_BYTES, is_fd: bool = False):
        """is_fd: the bus may carry CAN FD frames."""
        if is_fd and path.suffix in _CLASSIC_ONLY:
            raise OutputError(_NO_FD.format(path.suffix[1:]))
        self.path = path
        self.frames = 0
        self.origin_s = math.nan
        self.problem = ""
        self._limit_bytes = limit_bytes
        self._shift_s: float | None = None
        self._writer: Any = _writer(path)
        self._written = 0
        self._queue: queue.SimpleQueue[can.Message | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="can-log", daemon=True)
        self._thread.start()

    def frame(self, frame: CanFrame, local_s: float, channel: int = 0) -> None:
        """Write a data frame with its time by the clock that times it. channel: 0 for the bus of the state."""
        if self._shift_s is None:
            self._shift_s = time.time() - local_s
            self.origin_s = local_s if math.isnan(self.origin_s) else self.origin_s
        self.frames += 1
        self._queue.put(can.Message(
            timestamp=local_s + self._shift_s, arbitration_id=frame.can_id, is_extended_id=frame.is_extended,
            data=frame.data, is_fd=frame.is_fd, channel=channel, check=False))

    def error_frame(self) -> None:
        """Write an error frame."""
        self._queue.put(can.Message(timestamp=time.time(), is_error_frame=True, channel=0))

    def restart(self) -> None:
        """Restart after the adapter was reopened, with a new clock."""
        self._shift_s = None

    def close(self) -> None:
        """Write the queue and close; safe to call twice."""
        if self._thread.is_alive():
            self._queue.put(None)
            self._thread.join()

    def _run(self) -> None:
        try:
            while (message := self._queue.get()) is not None:
                self._write(message)
            self._stop()
        # A full disk ends the log, but not the test; writers of other formats raise various exceptions.
        except Exception as error:
            self.problem = f"The CAN log {self.path} ends before the test: {getattr(error, 'strerror', '') or error}."
            self._stop()

    def _write(self, message: can.Message) -> None:
        if self._writer is None:
            return
        if message.is_fd and self.path.suffix in _CLASSIC_ONLY:
            self.problem = f"The CAN log {self.path} ends before the test: {_NO_FD.format(self.path.suffix[1:])}"
            self._stop()
            return
        self._writer.on_message_received(message)
        self._written += 1
        if self._written % _SIZE_LOOK == 0 and self.path.stat().st_size > self._limit_bytes:
            self.problem = (f"The CAN log {self.path} ends before the test: it has reached "
                            f"{self._limit_bytes // 1024 ** 2} MiB, the limit.")
            self._stop()

    def _stop(self) -> None:
        writer, self._writer = self._writer, None
        if writer is not None:
            with contextlib.suppress(Exception):
                writer.stop()


def _writer(path: pathlib.Path) -> Any:
    options = {"max_container_size": _BLF_CONTAINER_BYTES} if path.suffix == ".blf" else {}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        return can.Logger(str(path), **options)
    except NotImplementedError:
        raise OutputError("A CAN log of the format mf4 needs the Python package asammdf, which is not installed; "
                          "install it, or choose blf.") from None
    except OSError as error:
        raise OutputError(f"The CAN log {path} cannot be written: {error.strerror or error}.") from None
