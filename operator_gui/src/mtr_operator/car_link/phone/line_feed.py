"""Feed of lines from a source of bytes, read in a thread; each fault is reported as a sentence."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import threading
import time
from abc import ABC, abstractmethod
from typing import Callable

from mtr_operator.domain.distance_feed import DistanceFeed, Reported
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.robot_status import RobotStatus

from .lines import LineReader, Told

# Wall times: of one read, between attempts to reconnect, and until a feed without any distance is reported.
READ_S = 0.1
REOPEN_S = 1.0
SILENCE_S = 5.0
# Further distances replace the oldest, which have been waiting for half a minute.
_MAX_WAITING = 6000


class SourceLost(Exception):
    """The source is disconnected; the text is the reason, without the source's name and without a full stop."""


class Source(ABC):
    """Source of bytes. Attributes: name: such as "TCP 127.0.0.1:7070"."""

    name: str

    @abstractmethod
    def open(self) -> None:
        """Open it; SourceLost states why it cannot be opened."""

    @abstractmethod
    def read(self) -> bytes:
        """Return the available bytes, after at most READ_S; SourceLost if the source cannot deliver further ones."""

    @abstractmethod
    def close(self) -> None:
        """Close it; safe to call twice."""


class LineFeed(DistanceFeed):
    """Feed that reopens its source after a loss. clock: the laptop's, monotonic, in s."""

    def __init__(self, source: Source, clock: Callable[[], float] = time.monotonic):
        self._source = source
        self._clock = clock
        self._lock = threading.Lock()
        self._reader = LineReader()
        self._waiting: collections.deque[Told] = collections.deque(maxlen=_MAX_WAITING)
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None
        self._lost = "it is not connected"
        self._opened_s = 0.0
        self._has_told = False

    @property
    def name(self) -> str:
        return self._source.name

    def connect(self) -> None:
        if self._thread is not None:
            return
        try:
            self._source.open()
        except SourceLost as error:
            raise ConnectionFailed(f"The phone's distance cannot be read from {self.name}: {error}; start what sends "
                                   "it, or correct the feed's address.") from None
        self._lost, self._opened_s = "", self._clock()
        self._stopping.clear()
        self._thread = threading.Thread(target=self._run, name="phone-feed", daemon=True)
        self._thread.start()

    def observe(self, status: RobotStatus) -> list[Reported]:
        with self._lock:
            told = list(self._waiting)
            self._waiting.clear()
        return [Reported(status.stamp_s, each.distance_m, each.feed_s, each.age_s) for each in told]

    @property
    def problem(self) -> str:
        with self._lock:
            if self._lost:
                return f"The phone's distance does not come from {self.name} any more: {self._lost}."
            if self._has_told or self._clock() - self._opened_s < SILENCE_S:
                return ""
            if self._reader.refused.count:
                return f"What comes from {self.name} is no distance: {self._reader.refused.last}"
            return (f"Nothing has come from {self.name} since it was connected; see whether it sends a line for each "
                    "distance.")

    @property
    def refused(self) -> Refused:
        with self._lock:
            return self._reader.refused

    def close(self) -> None:
        self._stopping.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join()
        self._source.close()
        with self._lock:
            self._lost = "it is not connected"

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                self._take(self._source.read())
            except SourceLost as error:
                self._reopen(str(error))

    def _take(self, data: bytes) -> None:
        with self._lock:
            told = self._reader.take(data, self._clock())
            self._waiting.extend(told)
            self._has_told = self._has_told or bool(told)

    def _reopen(self, reason: str) -> None:
        """Try until the source is open again."""
        with self._lock:
            self._lost = reason
        self._source.close()
        while not self._stopping.wait(REOPEN_S):
            try:
                self._source.open()
            except SourceLost as error:
                with self._lock:
                    self._lost = str(error)
                continue
            with self._lock:
                self._reader.restart()
                self._lost, self._opened_s = "", self._clock()
            return
