"""Frames for the port: bounded in bytes and age, and given up after a gap in which nobody served the line."""
# SPDX-License-Identifier: Apache-2.0
import collections
import math
from typing import Deque, Iterable, NamedTuple

# A line of 57600 baud carries so much in MAX_AGE_S; what is older the firmware would refuse.
MAX_BYTES = 3000
MAX_AGE_S = 0.5
# A turn of the line takes 0.1 s at most. After a longer gap messages of before it still arrive for a moment.
GAP_S = 0.5
DEAF_S = 0.2


class _Queued(NamedTuple):
    data: bytes
    since_s: float


class SendQueue:
    """Frames that the port has not taken yet; times are of a clock that never steps.

    Attributes:
        dropped: frames and messages that were given up.
    """

    def __init__(self) -> None:
        self._frames: Deque[_Queued] = collections.deque()
        self._rest = b""
        self._turn_s = math.inf
        self._deaf_until_s = -math.inf
        self.dropped = 0

    def __bool__(self) -> bool:
        return bool(self._rest or self._frames)

    def clear(self) -> None:
        """A new port: nothing of before is meant for it."""
        self._frames.clear()
        self._rest, self._turn_s, self._deaf_until_s = b"", math.inf, -math.inf

    def is_deaf(self, now_s: float) -> bool:
        """True shortly after a gap since the last turn; to be asked in each turn, before anything is sent."""
        if now_s - self._turn_s > GAP_S:
            self._deaf_until_s = now_s + DEAF_S
            self.dropped += len(self._frames)
            self._frames.clear()
        self._turn_s = now_s
        return now_s < self._deaf_until_s

    def put(self, frames: Iterable[bytes], now_s: float) -> None:
        """Queue frames, whole ones."""
        self._frames.extend(_Queued(data, now_s) for data in frames)
        excess = sum(len(frame.data) for frame in self._frames) - MAX_BYTES
        while excess > 0:
            excess -= len(self._frames.popleft().data)
            self.dropped += 1

    def next(self, now_s: float) -> bytes:
        """What the port shall take now; a frame that has begun goes on, however old."""
        while self._frames and now_s - self._frames[0].since_s > MAX_AGE_S:
            self._frames.popleft()
            self.dropped += 1
        if not self._rest and self._frames:
            self._rest = self._frames.popleft().data
        return self._rest

    def taken(self, count: int) -> None:
        """The port took so many bytes of what `next` gave."""
        self._rest = self._rest[count:]
