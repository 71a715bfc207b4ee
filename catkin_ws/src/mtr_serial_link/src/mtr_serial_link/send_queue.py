"""Queue of frames for the port, limited in bytes and age, and cleared after a gap in the service of the line."""
# SPDX-License-Identifier: Apache-2.0
import collections
import math
from typing import Deque, Iterable, NamedTuple

# A line of 57600 baud transmits this in MAX_AGE_S; the firmware would reject older messages.
MAX_BYTES = 3000
MAX_AGE_S = 0.5
# An iteration of the line lasts at most 0.1 s. After a longer gap, outdated messages still arrive for a moment.
GAP_S = 0.5
DEAF_S = 0.2


class _Queued(NamedTuple):
    data: bytes
    since_s: float


class SendQueue:
    """Frames that are not yet written to the port; times are of a monotonic clock.

    Attributes:
        dropped: number of discarded frames and messages.
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
        """Discard everything, because a new port must not receive earlier messages."""
        self._frames.clear()
        self._rest, self._turn_s, self._deaf_until_s = b"", math.inf, -math.inf

    def is_deaf(self, now_s: float) -> bool:
        """Return True shortly after a gap since the last iteration; must be called in each iteration before sending."""
        if now_s - self._turn_s > GAP_S:
            self._deaf_until_s = now_s + DEAF_S
            self.dropped += len(self._frames)
            self._frames.clear()
        self._turn_s = now_s
        return now_s < self._deaf_until_s

    def put(self, frames: Iterable[bytes], now_s: float) -> None:
        """Queue complete frames."""
        self._frames.extend(_Queued(data, now_s) for data in frames)
        excess = sum(len(frame.data) for frame in self._frames) - MAX_BYTES
        while excess > 0:
            excess -= len(self._frames.popleft().data)
            self.dropped += 1

    def next(self, now_s: float) -> bytes:
        """Return the bytes for the port; a partly written frame is always completed."""
        while self._frames and now_s - self._frames[0].since_s > MAX_AGE_S:
            self._frames.popleft()
            self.dropped += 1
        if not self._rest and self._frames:
            self._rest = self._frames.popleft().data
        return self._rest

    def taken(self, count: int) -> None:
        """Mark bytes returned by `next` as written."""
        self._rest = self._rest[count:]
