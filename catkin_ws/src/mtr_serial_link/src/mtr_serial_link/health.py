"""Judges the serial line: what it counts, and which one thing is wrong with it."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import Dict, Optional

from .frames import FrameCounts
from .parameters import LinkParameters

# So many bytes without a frame are no accident: the longest frame of a device that speaks our protocol is shorter.
BYTES_WITHOUT_FRAME = 200
REVISION_1_SYNCS = 3


class LineProblem(enum.Enum):
    """What is wrong with an open port; the value says it to a person."""

    NONE = ""
    WAITING = "is open and waits for the board's first message"
    SILENT = "is open but silent; check the board's power, the cable and that the firmware is flashed"
    WRONG_BAUD = "gives bytes but no messages; check the baud rate on both sides, and that nothing else prints there"
    REVISION = "speaks revision 1 of the rosserial protocol, this machine revision 2; flash a newer firmware"
    LOST = "has fallen silent; check the board's power and the cable"


class Health:
    """Counters since the start of the program, and the state of the line since the port was opened.

    Attributes:
        bytes_in, frames: received.
        oversized: messages for the device that it cannot take.
        unknown_topics: frames of topics that the device has not described.
        refusals: sentences about what could not be served, with how often.
        counts: of the parser.
    """

    def __init__(self, parameters: LinkParameters):
        self._parameters = parameters
        self._started_s = -math.inf
        self._frame_s: Optional[float] = None
        self._bytes_at_frame = 0
        self.bytes_in = self.frames = self.oversized = self.unroutable = self.unknown_topics = 0
        self.refusals: Dict[str, int] = {}
        self.counts = FrameCounts()
        self._revision_1_at_start = 0

    def start(self, now_s: float) -> None:
        """The port was opened."""
        self._started_s, self._frame_s = now_s, None
        self._bytes_at_frame = self.bytes_in
        self._revision_1_at_start = self.counts.revision_1_syncs

    def heard(self, size: int, counts: FrameCounts, now_s: float) -> None:
        """Bytes have come."""
        self.bytes_in += size
        self.counts = counts
        if self._frame_s == now_s:
            self._bytes_at_frame = self.bytes_in

    def frame(self, now_s: float) -> None:
        """A good frame has come."""
        self.frames += 1
        self._frame_s = now_s

    def drop(self, name: str, size: int, limit: Optional[int]) -> None:
        """A message for the device was not sent."""
        if limit is None:
            self.unroutable += 1
            return
        self.oversized += 1
        self.refuse(f"A message of {size} bytes for {name} was not sent: the firmware takes at most {limit}.")

    def refuse(self, sentence: str) -> None:
        """Something could not be served."""
        self.refusals[sentence] = self.refusals.get(sentence, 0) + 1

    def problem(self, now_s: float) -> LineProblem:
        """What is wrong now."""
        if self._frame_s is not None and now_s - self._frame_s <= self._parameters.lost_after_s:
            return LineProblem.NONE
        strange = self.bytes_in - self._bytes_at_frame
        if self.counts.revision_1_syncs - self._revision_1_at_start >= REVISION_1_SYNCS and self._frame_s is None:
            return LineProblem.REVISION
        if strange >= BYTES_WITHOUT_FRAME:
            return LineProblem.WRONG_BAUD
        if self._frame_s is not None:
            return LineProblem.LOST
        return LineProblem.SILENT if now_s - self._started_s > self._parameters.lost_after_s else LineProblem.WAITING
